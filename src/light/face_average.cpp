// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>

#include "color_planes.h"
#include "kiln/light/source.h"
#include "kiln/parallel/rows.h"
#include "sphere_texels.h"

namespace kiln {
namespace {

/// A piece of an axis of a face, [-1,1], that lies in one texel of both images.
struct Piece {
  int in, out;
  double from, to;
};

// Where the samples of the source end along an axis: [n + 1].
std::vector<double> sample_edges(int n, bool node_aligned) {
  std::vector<double> edges;
  for (int i = 0; i <= n; ++i) {
    edges.push_back(node_aligned ? std::clamp((2.0 * i - 1) / (n - 1) - 1, -1.0, 1.0)
                                 : 2.0 * i / n - 1);
  }
  return edges;
}

std::vector<Piece> pieces_of(const std::vector<double>& in_edges, int size) {
  std::vector<Piece> pieces;
  int in = 0;
  for (int out = 0; out < size; ++out) {
    const double end = 2.0 * (out + 1) / size - 1;
    double from = 2.0 * out / size - 1;
    while (from < end) {
      const double in_end = in_edges[static_cast<size_t>(in) + 1];
      const double to = std::min(end, in_end);
      if (to > from) pieces.push_back({in, out, from, to});
      from = std::max(from, to);
      if (in_end > end || in + 2 == static_cast<int>(in_edges.size())) break;
      ++in;
    }
  }
  return pieces;
}

/// Six faces being averaged, one row of texels at a time.
class FaceAverage {
 public:
  FaceAverage(const SphereImage& cube, int size)
      : size_(size), pieces_(pieces_of(sample_edges(cube.size().width, cube.node_aligned), size)) {
    for (const Layers& face : cube.images) faces_.push_back(color_planes(face));
  }

  void write_row(int y, std::vector<Layers>& to) const {
    const auto width = static_cast<size_t>(size_);
    std::vector<double> sums(18 * width), whole(width);
    for (const Piece& down : pieces_) {
      if (down.out == y) add_row(down, sums, whole);
    }
    for (size_t i = 0; i < 18; ++i) {
      float* row = to[i / 3].layers[i % 3].plane.row(y);
      for (size_t x = 0; x < width; ++x) {
        row[x] = static_cast<float>(sums[i * width + x] / whole[x]);
      }
    }
  }

 private:
  void add_row(const Piece& down, std::vector<double>& sums, std::vector<double>& whole) const {
    const auto width = static_cast<size_t>(size_);
    for (const Piece& across : pieces_) {
      const double solid_angle =
          cube_rectangle_solid_angle({across.from, down.from}, {across.to, down.to});
      const auto x = static_cast<size_t>(across.out);
      whole[x] += solid_angle;
      for (size_t i = 0; i < 18; ++i) {
        sums[i * width + x] += solid_angle * faces_[i / 3].planes[i % 3]->at(across.in, down.in);
      }
    }
  }

  int size_;
  std::vector<Piece> pieces_;  // the same across and down
  std::vector<ColorPlanes> faces_;
};

void look_up_row(const SphereTexels& texels, int face, int y, Layers& to) {
  const int size = to.size.width;
  for (int x = 0; x < size; ++x) {
    const Vec2<double> uv{(x + 0.5) / size, (y + 0.5) / size};
    const Vec3<double> value =
        texels.at(normalize(cube_to_direction(static_cast<CubeFace>(face), uv)));
    to.layers[0].plane.at(x, y) = static_cast<float>(value.x);
    to.layers[1].plane.at(x, y) = static_cast<float>(value.y);
    to.layers[2].plane.at(x, y) = static_cast<float>(value.z);
  }
}

}  // namespace

std::vector<Layers> average_faces(const SphereImage& cube, int size) {
  std::vector<Layers> faces(6, make_layers({size, size}, {"R", "G", "B"}));
  const int cells = cube.size().width - (cube.node_aligned ? 1 : 0);
  if (size <= cells) {
    const FaceAverage average(cube, size);
    for_rows(size, [&](int y) { average.write_row(y, faces); });
    return faces;
  }
  const SphereTexels texels(cube);
  for_rows(6 * size, [&](int row) {
    const int face = row / size;
    look_up_row(texels, face, row % size, faces[static_cast<size_t>(face)]);
  });
  return faces;
}

}  // namespace kiln
