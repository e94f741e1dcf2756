// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "kiln/io/image_file.h"
#include "packed_texel.h"
#include "rgbd.h"
#include "samples.h"
#include "stored_planes.h"
#include "texel_pack.h"

namespace kiln {
namespace {

using Texel = std::array<float, 4>;

// One texel of a type whose channels depend on one another.
Texel coded_texel(const Texel& texel, PixelType type, WriteFacts& facts) {
  if (type != PixelType::Rgbd8) return io::unpacked(io::packed(texel, type, facts), type);
  Texel bytes = io::rgbd_texel({texel[0], texel[1], texel[2]}, facts);
  for (float& value : bytes) value = static_cast<float>(io::quantised(value, 255, facts)) / 255.0f;
  const std::array<float, 3> color = io::rgbd_color(bytes);
  return {color[0], color[1], color[2], 1.0f};
}

void code_texels(const io::StoredPlanes& from, PixelType type, const std::vector<Plane*>& to) {
  WriteFacts facts;
  const Size size = to.front()->size();
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      Texel texel{0.0f, 0.0f, 0.0f, 1.0f};
      for (size_t c = 0; c < to.size(); ++c) texel[c] = from.planes[c]->at(x, y);
      texel = coded_texel(texel, type, facts);
      for (size_t c = 0; c < to.size(); ++c) to[c]->at(x, y) = texel[c];
    }
  }
}

void code_samples(const Plane& from, PixelType type, Plane& to) {
  WriteFacts facts;
  const auto width = static_cast<size_t>(from.width());
  std::vector<std::byte> row(width * io::sample_bytes(type));
  for (int y = 0; y < from.height(); ++y) {
    io::store_samples(from.texels_of_row(y), type, 1, row.data(), facts);
    io::load_samples(row.data(), type, 1, {to.row(y), width});
  }
}

bool has_samples(PixelType type) { return !io::is_packed(type) && type != PixelType::Rgbd8; }

// The planes of `result` that belong to those of `image`, in the order of the file.
std::vector<Plane*> planes_like(const io::StoredPlanes& stored, const Layers& image,
                                Layers& result) {
  std::vector<Plane*> planes;
  for (const Plane* plane : stored.planes) {
    const auto at = std::find_if(image.layers.begin(), image.layers.end(),
                                 [&](const Layer& layer) { return &layer.plane == plane; });
    planes.push_back(&result.layers[static_cast<size_t>(at - image.layers.begin())].plane);
  }
  return planes;
}

}  // namespace

Layers coded(const Layers& image, PixelType type) {
  const io::StoredPlanes stored = io::in_file_order(image);
  io::require_room(stored, type);
  Layers result = image;
  if (image.layers.empty()) return result;
  const std::vector<Plane*> planes = planes_like(stored, image, result);
  if (!has_samples(type)) {
    code_texels(stored, type, planes);
    return result;
  }
  for (size_t c = 0; c < planes.size(); ++c) code_samples(*stored.planes[c], type, *planes[c]);
  return result;
}

}  // namespace kiln
