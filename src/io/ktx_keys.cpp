// SPDX-License-Identifier: Apache-2.0
#include "ktx_keys.h"

#include <fmt/format.h>

#include <utility>

#include "byte_text.h"
#include "kiln/core/error.h"

namespace kiln::io {
namespace {

using Keys = std::map<std::string, std::string>;

void add_attributes(const Attributes& attributes, const std::string& writer_key, Keys& keys) {
  bool software_seen = writer_key.empty();
  for (const auto& [name, text] : attributes) {
    if (name == "Software" && !software_seen) {
      software_seen = true;
      keys[writer_key] = text;
      continue;
    }
    const bool own = name.empty() || name.starts_with("KTX") || name.starts_with("ktx");
    if (own || name.find('\0') != std::string::npos || !keys.emplace(name, text).second) {
      throw Error(Fault::Usage,
                  fmt::format("metadata name '{}' is empty, used twice or the format's own", name));
    }
  }
}

}  // namespace

std::string ktx_keys(Keys own, const Attributes& attributes, const std::string& writer_key) {
  Keys keys = std::move(own);
  if (!writer_key.empty()) keys.emplace(writer_key, "kiln");
  add_attributes(attributes, writer_key, keys);
  std::string bytes;
  for (const auto& [name, text] : keys) {
    append_little(bytes, name.size() + text.size() + 2, 4);
    bytes.append(name).append(1, '\0').append(text).append(1, '\0');
    pad_to(bytes, 4);
  }
  return bytes;
}

}  // namespace kiln::io
