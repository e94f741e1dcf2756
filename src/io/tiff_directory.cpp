// SPDX-License-Identifier: Apache-2.0
#include "tiff_directory.h"

#include "byte_text.h"

namespace kiln::io {
namespace {

enum Type : uint16_t { Ascii = 2, Short = 3, Long = 4, Long8 = 16 };

}  // namespace

TiffDirectories::TiffDirectories(ByteStream& out, bool big)
    : out_(out), big_(big), link_(big ? 8 : 4) {
  std::string header = "II";
  append_little(header, big ? 43 : 42, 2);
  if (big) append_little(header, 8, 4);  // the width of places, and a zero
  append_little(header, 0, place_bytes());
  out_.append(header);
}

void TiffDirectories::add_shorts(uint16_t tag, const std::vector<uint16_t>& values) {
  Field field{Short, values.size(), {}};
  for (const uint16_t value : values) append_little(field.bytes, value, 2);
  fields_[tag] = std::move(field);
}

void TiffDirectories::add_long(uint16_t tag, uint32_t value) {
  Field field{Long, 1, {}};
  append_little(field.bytes, value, 4);
  fields_[tag] = std::move(field);
}

void TiffDirectories::add_places(uint16_t tag, const std::vector<uint64_t>& values) {
  Field field{big_ ? Long8 : Long, values.size(), {}};
  for (const uint64_t value : values) append_little(field.bytes, value, place_bytes());
  fields_[tag] = std::move(field);
}

void TiffDirectories::add_text(uint16_t tag, std::string_view text) {
  fields_[tag] = {Ascii, text.size() + 1, std::string(text) + '\0'};
}

void TiffDirectories::begin_at_even_place() {
  if (out_.position() % 2 != 0) out_.append(std::string_view("\0", 1));
}

void TiffDirectories::write() {
  std::map<uint16_t, uint64_t> places;
  for (const auto& [tag, field] : fields_) {
    if (field.bytes.size() <= place_bytes()) continue;
    begin_at_even_place();
    places[tag] = out_.position();
    out_.append(field.bytes);
  }
  begin_at_even_place();
  const uint64_t place = out_.position();
  std::string directory;
  append_little(directory, fields_.size(), big_ ? 8 : 2);
  for (const auto& [tag, field] : fields_) {
    append_little(directory, tag, 2);
    append_little(directory, field.type, 2);
    append_little(directory, field.count, place_bytes());
    std::string value = field.bytes;
    if (const auto at = places.find(tag); at != places.end()) {
      value.clear();
      append_little(value, at->second, place_bytes());
    }
    value.resize(place_bytes(), '\0');
    directory += value;
  }
  const uint64_t next_link = place + directory.size();
  append_little(directory, 0, place_bytes());
  out_.append(directory);
  const uint64_t end = out_.position();
  std::string link;
  append_little(link, place, place_bytes());
  out_.seek(link_);
  out_.append(link);
  out_.seek(end);
  link_ = next_link;
  fields_.clear();
}

}  // namespace kiln::io
