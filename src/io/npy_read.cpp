// SPDX-License-Identifier: Apache-2.0
#include "npy_read.h"

#include <Imath/half.h>
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstring>
#include <limits>

#include "byte_cursor.h"
#include "samples.h"

namespace kiln::io {
namespace {

[[noreturn]] void refuse(const std::string& reason) { throw Error(Fault::Input, reason); }

struct Header {
  char kind = 'f';  // 'f', 'u', 'i', 'b'
  size_t bytes = 4;
  bool big_endian = false;
  bool fortran = false;
  std::vector<int> shape;
  size_t count = 1;
  size_t first = 0;
};

// What follows 'KEY': in the text of a Python dictionary.
std::string_view after_key(std::string_view text, std::string_view key) {
  for (const char quote : {'\'', '"'}) {
    const std::string wanted = fmt::format("{0}{1}{0}", quote, key);
    const size_t at = text.find(wanted);
    if (at == std::string_view::npos) continue;
    std::string_view rest = text.substr(at + wanted.size());
    rest.remove_prefix(std::min(rest.find_first_not_of(" :"), rest.size()));
    return rest;
  }
  refuse(fmt::format("damaged .npy header: it has no '{}'", key));
}

void read_description(std::string_view text, Header& header) {
  const std::string_view quoted = text.substr(0, 8);
  const size_t end = quoted.find_first_of("'\"", 1);
  const std::string_view name =
      quoted.empty() || end == std::string_view::npos ? "" : quoted.substr(1, end - 1);
  constexpr std::string_view known[] = {"f2", "f4", "f8", "u1", "u2", "u4",
                                        "u8", "i1", "i2", "i4", "i8", "b1"};
  const bool ordered =
      name.size() == 3 && std::string_view("<>|=").find(name[0]) != std::string_view::npos;
  const std::string_view type = ordered ? name.substr(1) : "";
  if (std::find(std::begin(known), std::end(known), type) == std::end(known)) {
    refuse(fmt::format("numbers of type {} are not read, expected f2 f4 f8 u1 u2 u4 u8 i1 i2 i4 i8",
                       quoted.substr(0, end == std::string_view::npos ? end : end + 1)));
  }
  header.kind = type[0];
  header.bytes = static_cast<size_t>(type[1] - '0');
  header.big_endian = name[0] == '>';
}

void read_shape(std::string_view text, const ReadLimits& limits, Header& header) {
  const std::string_view list = text.substr(0, text.find(')'));
  for (size_t at = list.find_first_of("0123456789"); at != std::string_view::npos;) {
    int length = 0;
    const auto parsed = std::from_chars(list.data() + at, list.data() + list.size(), length);
    if (parsed.ec != std::errc{} || header.shape.size() == 8) {
      refuse(fmt::format("damaged .npy header: a shape of {}", list));
    }
    header.shape.push_back(length);
    at = list.find_first_of("0123456789", static_cast<size_t>(parsed.ptr - list.data()));
  }
  const auto most = static_cast<size_t>(limits.max_texels) *
                    static_cast<size_t>(std::max(1, limits.max_channels));
  for (const int length : header.shape) {
    if (length < 1) refuse(fmt::format("an empty array: its shape is {})", list));
    if (header.count > most / static_cast<size_t>(length)) {
      refuse(fmt::format("the header claims a shape of {}); more than {} numbers are not read",
                         list, most));
    }
    header.count *= static_cast<size_t>(length);
  }
  if (header.shape.empty()) header.shape = {1};
}

Header header_of(ByteView bytes, const ReadLimits& limits) {
  ByteCursor cursor(bytes, 6);
  const uint64_t version = cursor.number(1);
  cursor.skip(1);
  if (version < 1 || version > 3)
    refuse(fmt::format("a .npy of version {}, expected 1 to 3", version));
  const auto length = static_cast<size_t>(cursor.number(version == 1 ? 2 : 4));
  const std::string_view text = cursor.text(length);
  Header header;
  header.first = cursor.at();
  read_description(after_key(text, "descr"), header);
  header.fortran = after_key(text, "fortran_order").starts_with("True");
  read_shape(after_key(text, "shape"), limits, header);
  if (header.count > cursor.left() / header.bytes) {
    refuse(fmt::format("truncated: the header claims {} numbers of {} bytes, {} bytes follow",
                       header.count, header.bytes, cursor.left()));
  }
  return header;
}

template <class Number>
double as_double(uint64_t bits) {
  Number number;
  std::memcpy(static_cast<void*>(&number), &bits, sizeof number);  // low bytes come first
  return static_cast<double>(number);
}

double number_at(const uint8_t* at, const Header& header) {
  uint64_t bits = 0;
  for (size_t i = 0; i < header.bytes; ++i) {
    bits = bits << 8 | at[header.big_endian ? i : header.bytes - 1 - i];
  }
  switch (header.kind) {
    case 'f':
      if (header.bytes == 2) return as_double<half>(bits);
      return header.bytes == 4 ? as_double<float>(bits) : as_double<double>(bits);
    case 'i':
      if (header.bytes == 1) return as_double<int8_t>(bits);
      if (header.bytes == 2) return as_double<int16_t>(bits);
      return header.bytes == 4 ? as_double<int32_t>(bits) : as_double<int64_t>(bits);
    default:
      return static_cast<double>(bits);
  }
}

bool is_scaled(const Header& header) { return header.kind == 'u' && header.bytes <= 2; }

// Numbers in the order of C. In Fortran's the first index is the fastest: the place of a number is
// carried along as its indices count up.
std::vector<double> values_of(ByteView bytes, const Header& header) {
  const double scale = !is_scaled(header) ? 1.0 : header.bytes == 1 ? 255.0 : 65535.0;
  const size_t axes = header.shape.size();
  std::vector<size_t> stride(axes, 1), index(axes, 0);
  for (size_t a = 1; a < axes; ++a) {
    const size_t to = header.fortran ? a : axes - 1 - a;
    const size_t from = header.fortran ? a - 1 : axes - a;
    stride[to] = stride[from] * static_cast<size_t>(header.shape[from]);
  }
  std::vector<double> values;
  values.reserve(header.count);
  size_t place = 0;
  for (size_t i = 0; i < header.count; ++i) {
    values.push_back(number_at(bytes.data() + header.first + place * header.bytes, header) / scale);
    for (size_t a = axes; a-- > 0;) {
      place += stride[a];
      if (++index[a] < static_cast<size_t>(header.shape[a])) break;
      place -= stride[a] * index[a];
      index[a] = 0;
    }
  }
  return values;
}

NumberArray::Stored stored_as(const Header& header) {
  using enum NumberArray::Stored;
  if (is_scaled(header)) return header.bytes == 1 ? Uint8 : Uint16;
  if (header.kind != 'f') return Integer;
  return header.bytes == 2 ? Half : header.bytes == 4 ? Float : Double;
}

PixelType pixel_type(const Header& header) {
  if (is_scaled(header)) return header.bytes == 1 ? PixelType::Uint8 : PixelType::Uint16;
  if (header.kind != 'f') {
    refuse(fmt::format("numbers of type {}{} are no image, expected f2 f4 f8 u1 u2", header.kind,
                       header.bytes));
  }
  return header.bytes == 2 ? PixelType::Half : PixelType::Float;
}

struct Extent {
  int depth = 1;
  Size slice;
  int channels = 1;
};

Extent extent_of(const std::vector<int>& shape) {
  constexpr int most_channels = 4;
  switch (shape.size()) {
    case 1:
      return {1, {shape[0], 1}, 1};
    case 2:
      return {1, {shape[1], shape[0]}, 1};
    case 3:
      if (shape[2] <= most_channels) return {1, {shape[1], shape[0]}, shape[2]};
      return {shape[0], {shape[2], shape[1]}, 1};
    case 4:
      return {shape[0], {shape[2], shape[1]}, shape[3]};
    default:
      refuse(fmt::format("an array of {} axes is no image, expected 1 to 4", shape.size()));
  }
}

FileFacts facts_of(const Header& header, const Extent& extent, const ReadLimits& limits) {
  const long long rows = static_cast<long long>(extent.slice.height) * extent.depth;
  require_within(limits, extent.slice.width, rows, extent.channels);
  FileFacts facts;
  facts.format = "npy";
  facts.size = {extent.slice.width, static_cast<int>(rows)};
  facts.channels = usual_channel_names(extent.channels);
  facts.type = pixel_type(header);
  if (header.bytes == 8) facts.notes.emplace_back("64-bit floats were rounded to 32 bits");
  if (extent.depth > 1) {
    facts.notes.push_back(
        fmt::format("a volume: {} slices of {} x {} texels stand one below the "
                    "other",
                    extent.depth, extent.slice.width, extent.slice.height));
  }
  return facts;
}

}  // namespace

NumberArray read_npy_array(ByteView bytes, const ReadLimits& limits) {
  const Header header = header_of(bytes, limits);
  NumberArray array;
  array.shape = header.shape;
  array.values = values_of(bytes, header);
  array.stored = stored_as(header);
  return array;
}

Volume read_npy_image(ByteView bytes, const ReadLimits& limits) {
  const Header header = header_of(bytes, limits);
  const Extent extent = extent_of(header.shape);
  Volume volume;
  volume.depth = extent.depth;
  volume.file.facts = facts_of(header, extent, limits);
  volume.file.image = make_layers(volume.file.facts.size, volume.file.facts.channels);
  const std::vector<double> values = values_of(bytes, header);
  size_t at = 0;
  for (int y = 0; y < volume.file.facts.size.height; ++y) {
    for (int x = 0; x < volume.file.facts.size.width; ++x) {
      for (Layer& layer : volume.file.image.layers) {
        layer.plane.at(x, y) = static_cast<float>(values[at++]);
      }
    }
  }
  return volume;
}

FileFacts inspect_npy(ByteView bytes, const ReadLimits& limits) {
  const Header header = header_of(bytes, limits);
  return facts_of(header, extent_of(header.shape), limits);
}

}  // namespace kiln::io
