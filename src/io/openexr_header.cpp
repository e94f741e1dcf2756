// SPDX-License-Identifier: Apache-2.0
#include "openexr_header.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <fmt/format.h>

#include "kiln/core/error.h"

namespace kiln::io {

Imf::PixelType library_type(PixelType type) {
  return type == PixelType::Half ? Imf::HALF : Imf::FLOAT;
}

void add_channels(const std::vector<std::string>& names, PixelType type, Imf::Header& header) {
  for (const std::string& name : names) {
    if (header.channels().findChannel(name) != nullptr || name.empty()) {
      throw Error(Fault::Usage, fmt::format("channel name '{}' is empty or used twice", name));
    }
    header.channels().insert(name, Imf::Channel(library_type(type)));
  }
}

void add_attributes(const Attributes& attributes, Imf::Header& header) {
  for (const auto& [name, text] : attributes) {
    if (name.empty() || header.find(name) != header.end()) {
      throw Error(Fault::Usage,
                  fmt::format("metadata name '{}' is empty, used twice or the format's own", name));
    }
    header.insert(name, Imf::StringAttribute(text));
  }
}

}  // namespace kiln::io
