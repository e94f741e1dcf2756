// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <string_view>

#include "attribute_lines.h"
#include "kiln/core/error.h"
#include "orientation.h"
#include "radiance_hdr.h"
#include "samples.h"

namespace kiln::io {
namespace {

using Rgbe = std::array<uint8_t, 4>;

[[noreturn]] void refuse(const std::string& reason) { throw Error(Fault::Input, reason); }

struct Header {
  int lines = 0;        // as stored
  int line_length = 0;  // [texel]
  int orientation = 1;
  size_t pixels_at = 0;
  Attributes attributes;
  std::vector<std::string> notes;
};

// Walks the bytes once; every read is checked.
class Cursor {
 public:
  explicit Cursor(ByteView bytes, size_t at = 0) : bytes_(bytes), at_(at) {}

  size_t at() const { return at_; }
  size_t left() const { return bytes_.size() - at_; }
  uint8_t byte() {
    if (left() == 0) refuse("truncated: the pixels end before the last scan line");
    return bytes_[at_++];
  }
  Rgbe pixel() {
    if (left() < 4) refuse("truncated: the pixels end before the last scan line");
    Rgbe result;
    for (uint8_t& component : result) component = bytes_[at_++];
    return result;
  }
  uint8_t peek(size_t ahead) const { return bytes_[at_ + ahead]; }
  std::string_view line() {
    const size_t start = at_;
    while (left() > 0 && bytes_[at_] != '\n') ++at_;
    if (left() == 0) refuse("truncated: the header has no end");
    const auto* text = reinterpret_cast<const char*>(bytes_.data()) + start;
    return {text, at_++ - start};
  }

 private:
  ByteView bytes_;
  size_t at_;
};

struct Axis {
  char sign = '+';
  char name = 'X';
  int length = 0;
};

// "-Y 512 " at the front of `text`, which loses it.
Axis take_axis(std::string_view& text) {
  Axis axis;
  const bool known = text.size() > 3 && (text[0] == '-' || text[0] == '+') &&
                     (text[1] == 'X' || text[1] == 'Y') && text[2] == ' ';
  if (!known) return axis;
  axis.sign = text[0];
  axis.name = text[1];
  const auto parsed = std::from_chars(text.data() + 3, text.data() + text.size(), axis.length);
  text.remove_prefix(static_cast<size_t>(parsed.ptr - text.data()));
  if (text.starts_with(' ')) text.remove_prefix(1);
  return axis;
}

// EXIF's number for what the resolution line says: which corner the first pixel lies in, and
// whether lines are columns.
int orientation_of(const Axis& line, const Axis& within) {
  const bool from_top = (line.name == 'Y' ? line : within).sign == '-';
  const bool from_left = (line.name == 'X' ? line : within).sign == '+';
  if (line.name == 'Y') return from_top ? (from_left ? 1 : 2) : (from_left ? 4 : 3);
  return from_top ? (from_left ? 5 : 6) : (from_left ? 8 : 7);
}

void read_resolution(std::string_view text, Header& header) {
  const std::string shown(text);
  const Axis line = take_axis(text);
  const Axis within = take_axis(text);
  if (line.length < 1 || within.length < 1 || line.name == within.name) {
    refuse(fmt::format("resolution line '{}' is not understood, expected such as '-Y 512 +X 1024'",
                       shown.substr(0, 40)));
  }
  header.lines = line.length;
  header.line_length = within.length;
  header.orientation = orientation_of(line, within);
}

Header read_header(ByteView bytes, const ReadLimits& limits) {
  Header header;
  Cursor cursor(bytes);
  for (std::string_view line = cursor.line(); !line.empty(); line = cursor.line()) {
    if (line.starts_with("# ")) {
      if (auto found = attribute_of(line.substr(2))) header.attributes.push_back(*found);
    }
    if (line.starts_with("FORMAT=") && line.find("xyze") != std::string_view::npos) {
      refuse("pixels are XYZE, expected RGBE");
    }
    if (line.starts_with("EXPOSURE=")) {
      header.notes.push_back(
          fmt::format("the header says {}; values are as stored, not divided by it", line));
    }
  }
  read_resolution(cursor.line(), header);
  require_within(limits, header.line_length, header.lines, 3);
  header.pixels_at = cursor.at();
  return header;
}

bool is_component_encoded(const Cursor& cursor, int length) {
  return length >= 8 && length < 32768 && cursor.left() >= 4 && cursor.peek(0) == 2 &&
         cursor.peek(1) == 2 && (cursor.peek(2) << 8 | cursor.peek(3)) == length;
}

// Each component of the line by itself: runs (count > 128) and literals.
void read_component_line(Cursor& cursor, std::vector<Rgbe>& line) {
  cursor.pixel();
  for (size_t component = 0; component < 4; ++component) {
    for (size_t x = 0; x < line.size();) {
      const uint8_t code = cursor.byte();
      const bool run = code > 128;
      const size_t count = run ? code - 128u : code;
      if (count == 0 || count > line.size() - x) refuse("damaged: a run leaves its scan line");
      const uint8_t value = run ? cursor.byte() : uint8_t{0};
      for (size_t end = x + count; x < end; ++x) {
        line[x][component] = run ? value : cursor.byte();
      }
    }
  }
}

// Whole pixels; (1, 1, 1, n) repeats the last one, and repeats in a row weigh 256 times more each.
void read_pixel_line(Cursor& cursor, std::vector<Rgbe>& line) {
  int shift = 0;
  for (size_t x = 0; x < line.size();) {
    const Rgbe pixel = cursor.pixel();
    if (pixel[0] != 1 || pixel[1] != 1 || pixel[2] != 1) {
      line[x++] = pixel;
      shift = 0;
      continue;
    }
    const size_t count = shift < 24 ? static_cast<size_t>(pixel[3]) << shift : line.size();
    if (x == 0 || count > line.size() - x) refuse("damaged: a run leaves its scan line");
    std::fill_n(line.begin() + static_cast<std::ptrdiff_t>(x), count, line[x - 1]);
    x += count;
    shift += 8;
  }
}

// The factor of each exponent; all are exact, the smallest as denormals.
std::array<float, 256> scales() {
  std::array<float, 256> result{};
  for (int exponent = 1; exponent < 256; ++exponent) {
    result[static_cast<size_t>(exponent)] = std::ldexp(1.0f, exponent - 136);
  }
  return result;
}

void place_line(const std::vector<Rgbe>& line, const std::array<float, 256>& scale, int y,
                Layers& image) {
  for (size_t c = 0; c < 3; ++c) {
    float* row = image.layers[c].plane.row(y);
    for (size_t x = 0; x < line.size(); ++x) {
      row[x] = static_cast<float>(line[x][c]) * scale[line[x][3]];
    }
  }
}

// A line needs at least 8 bytes when run-length encoded by component (one run of two bytes covers
// 127 texels of a component), and a repeat of whole pixels cannot open it.
void require_enough(const Header& header, size_t bytes) {
  if (bytes / 4 < static_cast<size_t>(header.lines)) {
    refuse(fmt::format("truncated: the header claims {} scan lines of {} texels, {} bytes follow",
                       header.lines, header.line_length, bytes));
  }
}

FileFacts facts_of(const Header& header) {
  FileFacts facts;
  facts.format = "hdr";
  facts.size = oriented(Size{header.line_length, header.lines}, header.orientation);
  facts.channels = {"R", "G", "B"};
  facts.type = PixelType::Float;
  facts.attributes = header.attributes;
  facts.notes = header.notes;
  note_orientation(header.orientation, facts);
  return facts;
}

}  // namespace

FileFacts inspect_hdr(ByteView bytes, const ReadLimits& limits) {
  return facts_of(read_header(bytes, limits));
}

ImageFile read_hdr(ByteView bytes, const Reading& reading) {
  constexpr int lines_at_once = 64;
  const Header header = read_header(bytes, reading.limits);
  Cursor cursor(bytes, header.pixels_at);
  require_enough(header, cursor.left());
  ImageFile result{make_layers({header.line_length, header.lines}, {"R", "G", "B"}),
                   facts_of(header)};
  std::vector<Rgbe> line(static_cast<size_t>(header.line_length));
  const std::array<float, 256> scale = scales();
  for (int y = 0; y < header.lines; ++y) {
    if (is_component_encoded(cursor, header.line_length)) {
      read_component_line(cursor, line);
    } else {
      read_pixel_line(cursor, line);
    }
    place_line(line, scale, y, result.image);
    if (y % lines_at_once == 0) reading.let_go();
  }
  result.image = oriented(std::move(result.image), header.orientation);
  return result;
}

}  // namespace kiln::io
