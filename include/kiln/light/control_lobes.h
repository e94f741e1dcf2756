// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "kiln/light/angles.h"
#include "kiln/light/environment.h"
#include "kiln/light/prefilter.h"
#include "kiln/light/straight_lobe.h"
#include "kiln/light/turn.h"
#include "kiln/math/vec.h"

namespace kiln {

/// Four directions around one, of weights that sum to 1.
template <class F>
struct AxesAround {
  std::array<Vec3<F>, 4> axes;  ///< unit
  std::array<F, 4> weights;
};

/// A mixture of lobes around four axes, each of two widths, and what it makes of an environment.
template <class F>
struct LobeMixture {
  AxesAround<F> around;
  std::array<F, 2> alpha2;
  std::array<F, 2> amplitude;  ///< share of each width over its integral [1/sr]
  Vec3<F> light;               ///< the mixture times the environment, integrated

  /// Toward the unit direction w, in the frame of the axes [1/sr].
  F operator()(const Vec3<F>& w) const {
    F sum(0);
    for (size_t j = 0; j < 4; ++j) {
      const F cosine = dot(around.axes[j], w);
      const F s = F(0.5) - F(0.5) * cosine;
      const F both = amplitude[0] * straight_lobe(alpha2[0], cosine, s) +
                     amplitude[1] * straight_lobe(alpha2[1], cosine, s);
      sum = fma(around.weights[j], both, sum);
    }
    return sum;
  }
};

/// The same of clamped cosines, over pi.
template <class F>
struct CosineMixture {
  AxesAround<F> around;
  Vec3<F> light;  ///< irradiance over pi

  F operator()(const Vec3<F>& w) const {
    F sum(0);
    for (size_t j = 0; j < 4; ++j) {
      sum = fma(around.weights[j], max(dot(around.axes[j], w), F(0)), sum);
    }
    return sum * F(1 / pi);
  }
};

/// Lobes whose product with an environment has a known integral: control variates for what a
/// surface reflects of it.
///
/// Each is what a GGX surface seen straight down reflects (straight_lobe), or the clamped cosine,
/// around a node of a grid of directions. A mixture of the lobes next to a direction and a width is
/// known as exactly as these are: integrals are mixed with the lobes, never interpolated.
/// @accuracy  as of Prefilter, 1e-5 rms of the mean radiance
class ControlLobes {
 public:
  static constexpr double least_alpha = 0.04;

  explicit ControlLobes(const Environment& environment);

  /// Lobes next to the unit direction d (world) and the width alpha; below least_alpha, of that.
  template <class F>
  LobeMixture<F> lobes(const Vec3<F>& d, F alpha) const;

  /// Cosines next to the unit normal n (world).
  template <class F>
  CosineMixture<F> cosines(const Vec3<F>& n) const;

 private:
  static constexpr double widths_per_octave = 2;
  static constexpr int node_numbers = 8;

  /// The cell of a grid that a direction lies in: axes of its corners, and where these are stored.
  template <class F>
  struct Cell {
    AxesAround<F> around;
    LaneIndex<F> first, stride;
  };
  template <class F>
  Cell<F> cell_of(const Vec3<F>& d, LaneIndex<F> grid) const;
  template <class F>
  Vec3<F> light_of(const Cell<F>& cell, int width) const;

  /// Where the nodes of a lobe are stored: as the first or the second width of a grid.
  struct Place {
    int grid, width;
  };
  void add_grid(int rows);
  void fill(const Prefilter& filtered, const FilterLobe& lobe, const std::vector<Place>& places);
  void store(const Layers& image, const Place& place);

  Turn turn_;
  std::vector<float> alpha2_, per_integral_;  ///< of each width
  // Of each grid. Grid i serves the widths i and i + 1; the last is that of cosines.
  std::vector<float> rows_;
  std::vector<std::int32_t> firsts_;  ///< in numbers of nodes_
  /// Row by row, R G B and nothing for each of the two widths; the last column is the first.
  std::vector<float> nodes_;
};

template <class F>
ControlLobes::Cell<F> ControlLobes::cell_of(const Vec3<F>& d, LaneIndex<F> grid) const {
  const F rows = table_at<F>(rows_.data(), grid);
  const F last_row = rows - F(1), last_column = F(2) * rows - F(1);
  const Vec2<F> uv = latlong_of(turn_.to_image(d));
  // NaN too is inside the grid.
  const F across = min(select(uv.x > F(0), uv.x, F(0)), F(1)) * last_column;
  const F down = min(select(uv.y > F(0), uv.y, F(0)), F(1)) * last_row;
  const F left = min(floor(across), last_column - F(1)), top = min(floor(down), last_row - F(1));
  const F tx = across - left, ty = down - top;
  const auto azimuth = [&](F column) {
    return sine_cosine_of_turns(column / last_column - F(0.5));
  };
  const auto polar = [&](F row) { return sine_cosine_of_turns(row / (F(2) * last_row)); };
  const auto east = azimuth(left + F(1)), west = azimuth(left);
  const auto north = polar(top), south = polar(top + F(1));
  const auto axis = [&](const SineCosine<F>& phi, const SineCosine<F>& theta) {
    return turn_.to_world(Vec3<F>{-phi.sine * theta.sine, theta.cosine, phi.cosine * theta.sine});
  };
  const LaneIndex<F> stride = to_index<F>(F(2 * node_numbers) * rows);
  const LaneIndex<F> first = index_at(firsts_.data(), grid) + to_index<F>(top) * stride +
                             to_index<F>(left) * LaneIndex<F>(node_numbers);
  const F one(1);
  return {{{axis(west, north), axis(east, north), axis(west, south), axis(east, south)},
           {(one - tx) * (one - ty), tx * (one - ty), (one - tx) * ty, tx * ty}},
          first,
          stride};
}

template <class F>
Vec3<F> ControlLobes::light_of(const Cell<F>& cell, int width) const {
  const float* of_width = nodes_.data() + 4 * width;
  const LaneIndex<F> right(node_numbers), below = cell.first + cell.stride;
  const auto node = [&](LaneIndex<F> at) {
    return Vec3<F>{table_at<F>(of_width, at), table_at<F>(of_width + 1, at),
                   table_at<F>(of_width + 2, at)};
  };
  const std::array<F, 4>& weights = cell.around.weights;
  return node(cell.first) * weights[0] + node(cell.first + right) * weights[1] +
         node(below) * weights[2] + node(below + right) * weights[3];
}

template <class F>
LobeMixture<F> ControlLobes::lobes(const Vec3<F>& d, F alpha) const {
  const auto last = static_cast<float>(alpha2_.size() - 1);
  const F octaves = log(max(alpha, F(1e-6)) * F(1 / least_alpha)) * F(1.4426950408889634);
  const F position = clamp_to_table(octaves * F(widths_per_octave), last);
  const F sharper = min(floor(position), F(last - 1));
  const F wider_share = position - sharper;
  const LaneIndex<F> level = to_index<F>(sharper);
  const LaneIndex<F> next = level + LaneIndex<F>(1);
  const Cell<F> cell = cell_of(d, level);
  LobeMixture<F> mixture;
  mixture.around = cell.around;
  mixture.alpha2 = {table_at<F>(alpha2_.data(), level), table_at<F>(alpha2_.data(), next)};
  mixture.amplitude = {(F(1) - wider_share) * table_at<F>(per_integral_.data(), level),
                       wider_share * table_at<F>(per_integral_.data(), next)};
  mixture.light = light_of(cell, 0) * (F(1) - wider_share) + light_of(cell, 1) * wider_share;
  return mixture;
}

template <class F>
CosineMixture<F> ControlLobes::cosines(const Vec3<F>& n) const {
  const Cell<F> cell = cell_of(n, LaneIndex<F>(static_cast<std::int32_t>(rows_.size()) - 1));
  return {cell.around, light_of(cell, 0)};
}

}  // namespace kiln
