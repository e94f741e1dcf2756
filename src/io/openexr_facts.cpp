// SPDX-License-Identifier: Apache-2.0
#include "openexr_facts.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfThreading.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "samples.h"

namespace kiln::io {
namespace {

using Imath::Box2i;

bool close_to(const Imath::V2f& a, const Imath::V2f& b) { return (a - b).length() < 1e-3f; }

bool same_primaries(const Imf::Chromaticities& a, const Imf::Chromaticities& b) {
  return close_to(a.red, b.red) && close_to(a.green, b.green) && close_to(a.blue, b.blue) &&
         close_to(a.white, b.white);
}

// Primaries and white of ACES: SMPTE ST 2065-1 (AP0) and Academy S-2014-004 (AP1).
std::optional<std::string> space_of(const Imf::Chromaticities& found) {
  const Imath::V2f white(0.32168f, 0.33767f);
  const Imf::Chromaticities ap0({0.7347f, 0.2653f}, {0.0f, 1.0f}, {0.0001f, -0.077f}, white);
  const Imf::Chromaticities ap1({0.713f, 0.293f}, {0.165f, 0.83f}, {0.128f, 0.044f}, white);
  if (same_primaries(found, Imf::Chromaticities())) return "lin_rec709_scene";
  if (same_primaries(found, ap0)) return "lin_ap0_scene";
  if (same_primaries(found, ap1)) return "lin_ap1_scene";
  return std::nullopt;
}

void note_chromaticities(const Imf::Header& header, FileFacts& facts) {
  if (!Imf::hasChromaticities(header)) return;
  const Imf::Chromaticities& c = Imf::chromaticities(header);
  facts.color_space_tag = space_of(c);
  if (facts.color_space_tag == "lin_rec709_scene") return;
  facts.notes.push_back(fmt::format(
      "chromaticities are not Rec.709: red {} {}, green {} {}, blue {} {}, white {} {}", c.red.x,
      c.red.y, c.green.x, c.green.y, c.blue.x, c.blue.y, c.white.x, c.white.y));
}

void note_environment(const Imf::Header& header, OpenexrUse use, FileFacts& facts) {
  const auto* border = header.findTypedAttribute<Imf::IntAttribute>("oiio:sampleborder");
  facts.node_aligned = border != nullptr && border->value() == 1;
  if (!Imf::hasEnvmap(header)) return;
  const bool latlong = Imf::envmap(header) == Imf::ENVMAP_LATLONG;
  facts.envmap = latlong ? Envmap::LatLong : Envmap::Cube;
  facts.node_aligned = true;
  if (use == OpenexrUse::Texture) return;
  if (latlong) {
    facts.notes.emplace_back("lat-long environment with samples on the border (envmap)");
  } else {
    facts.notes.emplace_back(
        "cube environment of six faces, one above the other, with samples on their borders "
        "(envmap)");
  }
}

void note_windows(const Imf::Header& header, FileFacts& facts) {
  const Box2i& shown = header.displayWindow();
  const Box2i& stored = header.dataWindow();
  if (shown == stored) return;
  facts.notes.push_back(fmt::format(
      "data window ({}, {})-({}, {}) differs from display window ({}, {})-({}, {}), which is "
      "returned, 0 where there is no data",
      stored.min.x, stored.min.y, stored.max.x, stored.max.y, shown.min.x, shown.min.y, shown.max.x,
      shown.max.y));
}

bool by_rank(const std::string& a, const std::string& b) {
  return channel_rank(a) < channel_rank(b);
}

void list_channels(const Imf::Header& header, FileFacts& facts) {
  facts.type = PixelType::Half;
  for (auto c = header.channels().begin(); c != header.channels().end(); ++c) {
    const Imf::Channel& channel = c.channel();
    if (channel.xSampling != 1 || channel.ySampling != 1) {
      throw Error(Fault::Input,
                  fmt::format("channel '{}' is subsampled {} x {}; expected every texel", c.name(),
                              channel.xSampling, channel.ySampling));
    }
    if (channel.type != Imf::HALF) facts.type = PixelType::Float;
    if (channel.type == Imf::UINT) {
      facts.notes.push_back(fmt::format("channel '{}' holds whole numbers", c.name()));
    }
    facts.channels.emplace_back(c.name());
  }
  std::stable_sort(facts.channels.begin(), facts.channels.end(), by_rank);
}

}  // namespace

void bound_openexr() {
  static const bool bounded = [] {
    constexpr int longest_edge = 1 << 20;
    constexpr int longest_tile_edge = 1 << 14;
    Imf::setGlobalThreadCount(0);
    Imf::Header::setMaxImageSize(longest_edge, longest_edge);
    Imf::Header::setMaxTileSize(longest_tile_edge, longest_tile_edge);
    return true;
  }();
  static_cast<void>(bounded);
}

// 'Cannot open image file "x.exr". ...'
std::string openexr_reason(const std::exception& error) {
  const std::string text = error.what();
  const size_t quoted = text.find("\". ");
  return quoted == std::string::npos ? text : text.substr(quoted + 3);
}

FileFacts openexr_facts(Imf::MultiPartInputFile& file, OpenexrUse use, const ReadLimits& limits) {
  const Imf::Header& header = file.header(0);
  if (header.hasType() && Imf::isDeepData(header.type())) {
    throw Error(Fault::Input, "holds deep data, expected flat pixels");
  }
  FileFacts facts;
  facts.format = "openexr";
  list_channels(header, facts);
  const Box2i& shown = header.displayWindow();
  const Box2i& stored = header.dataWindow();
  const auto channels = static_cast<long long>(facts.channels.size());
  for (const Box2i& window : {shown, stored}) {
    require_within(limits, extent(window.min.x, window.max.x), extent(window.min.y, window.max.y),
                   channels);
  }
  facts.size = {shown.max.x - shown.min.x + 1, shown.max.y - shown.min.y + 1};
  facts.stored_as_shown = shown == stored;
  if (file.parts() > 1) {
    facts.notes.push_back(fmt::format("has {} parts; the first is read", file.parts()));
  }
  if (use == OpenexrUse::Image) note_windows(header, facts);
  note_chromaticities(header, facts);
  note_environment(header, use, facts);
  for (auto a = header.begin(); a != header.end(); ++a) {
    const auto* text = dynamic_cast<const Imf::StringAttribute*>(&a.attribute());
    if (text != nullptr) facts.attributes.emplace_back(a.name(), text->value());
  }
  return facts;
}

}  // namespace kiln::io
