// SPDX-License-Identifier: Apache-2.0
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfTiledInputPart.h>
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "kiln/core/error.h"
#include "openexr_facts.h"
#include "openexr_file.h"
#include "openexr_header.h"
#include "openexr_texture.h"
#include "orientation.h"
#include "samples.h"

namespace kiln::io {
namespace {

using Imath::Box2i;

bool is_cube(const Imf::Header& header) {
  return Imf::hasEnvmap(header) && Imf::envmap(header) == Imf::ENVMAP_CUBE;
}

Size size_of(const Box2i& window) {
  return {static_cast<int>(extent(window.min.x, window.max.x)),
          static_cast<int>(extent(window.min.y, window.max.y))};
}

// How many of the levels, from the largest, are what a texture has.
int own_levels(const Imf::TiledInputPart& part, Size largest) {
  const Imf::Header& header = part.header();
  const auto* stated = header.findTypedAttribute<Imf::IntAttribute>(own_levels_name);
  const int all = std::min(part.numXLevels(), part.numYLevels());
  const int most = stated != nullptr ? std::clamp(stated->value(), 1, all) : all;
  for (int l = 1; l < most; ++l) {
    const Size size = size_of(part.dataWindowForLevel(l, l));
    const Size wanted{std::max(1, largest.width >> l), std::max(1, largest.height >> l)};
    if (size != wanted || (is_cube(header) && size.height != 6 * size.width)) return l;
  }
  return most;
}

Layers read_level(Imf::TiledInputPart& part, const FileFacts& facts, int level) {
  const Box2i window = part.dataWindowForLevel(level, level);
  Layers image = make_layers(size_of(window), facts.channels);
  Imf::FrameBuffer frame;
  for (Layer& layer : image.layers) {
    const auto row_bytes = static_cast<size_t>(layer.plane.stride()) * sizeof(float);
    frame.insert(layer.name,
                 Imf::Slice::Make(Imf::FLOAT, layer.plane.row(0), window.min, image.size.width,
                                  image.size.height, sizeof(float), row_bytes));
  }
  part.setFrameBuffer(frame);
  part.readTiles(0, part.numXTiles(level) - 1, 0, part.numYTiles(level) - 1, level, level);
  return image;
}

std::vector<Layers> faces_of(Layers image, bool cube) {
  if (cube) return faces_of_stack(image);
  std::vector<Layers> one;
  one.push_back(std::move(image));
  return one;
}

void check_cube(Size size) {
  if (size.height == 6LL * size.width) return;
  throw Error(Fault::Input,
              fmt::format("a cube of {} x {} texels, expected six squares one below the other",
                          size.width, size.height));
}

// Of a file of our own the levels beyond are no loss.
void note_levels(const Imf::TiledInputPart& part, int levels, FileFacts& facts) {
  const int all = std::min(part.numXLevels(), part.numYLevels());
  const bool stated =
      part.header().findTypedAttribute<Imf::IntAttribute>(own_levels_name) != nullptr;
  if (levels == all || stated || is_cube(part.header())) return;
  facts.notes.push_back(fmt::format(
      "{} levels; the first {} is read, since the next is not half as large, rounded down", all,
      levels));
}

Texture read_levels(Imf::MultiPartInputFile& file, FileFacts& facts, const ReadLimits& limits) {
  Imf::TiledInputPart part(file, 0);
  const Size largest = size_of(part.header().dataWindow());
  const bool cube = is_cube(part.header());
  if (cube) check_cube(largest);
  const int levels = own_levels(part, largest);
  require_levels_within(limits, largest.width, largest.height, levels, 1);
  note_levels(part, levels, facts);
  Texture texture;
  // The smallest first: what is damaged shows before much is read.
  for (int l = levels; l-- > 0;) {
    texture.levels.push_back(faces_of(read_level(part, facts, l), cube));
  }
  std::reverse(texture.levels.begin(), texture.levels.end());
  return texture;
}

bool has_levels(const Imf::Header& header) {
  return header.hasTileDescription() && header.tileDescription().mode != Imf::ONE_LEVEL;
}

}  // namespace

Layers stacked_faces(const std::vector<Layers>& faces) {
  const Size size = faces.front().size;
  Layers stack{{size.width, 6 * size.height}, {}};
  for (const Layer& layer : faces.front().layers) stack.add(layer.name);
  for (size_t f = 0; f < faces.size(); ++f) {
    const bool upright = f != 2 && f != 3;
    const Layers turned = oriented(faces[f], upright ? 2 : 4);
    const int top = static_cast<int>(f) * size.height;
    for (size_t c = 0; c < stack.layers.size(); ++c) {
      for (int y = 0; y < size.height; ++y) {
        const auto row = turned.layers[c].plane.texels_of_row(y);
        std::copy(row.begin(), row.end(), stack.layers[c].plane.row(top + y));
      }
    }
  }
  return stack;
}

std::vector<Layers> faces_of_stack(const Layers& stack) {
  const Size size{stack.size.width, stack.size.height / 6};
  std::vector<Layers> faces;
  for (int f = 0; f < 6; ++f) {
    Layers face{size, {}};
    for (const Layer& layer : stack.layers) {
      Plane& plane = face.add(layer.name);
      for (int y = 0; y < size.height; ++y) {
        const auto row = layer.plane.texels_of_row(f * size.height + y);
        std::copy(row.begin(), row.end(), plane.row(y));
      }
    }
    faces.push_back(oriented(std::move(face), f != 2 && f != 3 ? 2 : 4));
  }
  return faces;
}

TextureFile read_openexr_texture(const std::filesystem::path& path, const ReadLimits& limits) {
  return reading_openexr([&] {
    Imf::MultiPartInputFile file(path.c_str(), 0, false);
    TextureFile result;
    result.facts = openexr_facts(file, Reading::Texture, limits);
    if (!file.partComplete(0)) throw Error(Fault::Input, "truncated OpenEXR file");
    const Imf::Header& header = file.header(0);
    if (has_levels(header)) {
      result.texture = read_levels(file, result.facts, limits);
    } else {
      Layers image = read_openexr(path, limits).image;
      if (is_cube(header)) check_cube(image.size);
      result.texture.levels.push_back(faces_of(std::move(image), is_cube(header)));
    }
    result.facts.size = result.texture.levels.front().front().size;
    result.stored = result.facts.type;
    return result;
  });
}

}  // namespace kiln::io
