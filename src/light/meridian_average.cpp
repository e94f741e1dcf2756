// SPDX-License-Identifier: Apache-2.0
#include "meridian_average.h"

#include <algorithm>
#include <array>

#include "kiln/image/projection.h"
#include "kiln/parallel/rows.h"

namespace kiln {
namespace {

constexpr int columns_at_once = 16;
// Strips of a side face between two meridians, in each of which edges between texels are level.
constexpr int least_strips = 256;

/// Azimuth of the middle of each side face, as u of the lat-long image [turn]; columns run
/// toward smaller u.
struct Side {
  CubeFace face;
  double middle;
};
constexpr std::array<Side, 4> sides = {
    {{CubeFace::px, 0.25}, {CubeFace::nx, 0.75}, {CubeFace::pz, 0.5}, {CubeFace::nz, 1.0}}};

/// Source rows that are seen, and the cosines of their edges.
struct Band {
  int first = 0, count = 0;
  std::vector<double> edges;  ///< [count + 1], falling

  Band(int height, int skipped) : first(skipped), count(height - 2 * skipped) {
    for (int row = 0; row <= count; ++row) {
      edges.push_back(std::cos(pi * (first + row) / height));
    }
  }
};

/// Where an edge between two texels of a column lies: in which row of the band, and at which z.
struct Edge {
  int row;
  double z;
};

// Mean z along the edge t = const of a column between two azimuths of the face, by two Gauss nodes.
double mean_height(double t, double from_rad, double to_rad) {
  constexpr double node = 0.21132486540518713;
  double sum = 0;
  for (const double share : {node, 1 - node}) {
    const double rise = t * std::cos(lerp(from_rad, to_rad, share));
    sum -= 0.5 * rise / std::sqrt(1 + rise * rise);
  }
  return sum;
}

std::vector<Edge> edges_at(const Band& band, const std::vector<double>& heights) {
  std::vector<Edge> edges;
  int row = 0;
  for (const double z : heights) {
    while (row + 1 < band.count && band.edges[static_cast<size_t>(row) + 1] >= z) ++row;
    edges.push_back({row, z});
  }
  return edges;
}

std::vector<Edge> edges_of_side(const Band& band, int size, double from_rad, double to_rad) {
  std::vector<double> heights;
  for (int j = 0; j <= size; ++j) {
    heights.push_back(mean_height(2.0 * j / size - 1, from_rad, to_rad));
  }
  return edges_at(band, heights);
}

/// Source columns that a column overlaps, and their shares of it.
struct Overlap {
  std::vector<int> columns;
  std::vector<double> shares;
};

Overlap overlap_of(int width, double from_u, double to_u) {
  const double from = from_u * width, to = to_u * width;
  Overlap overlap;
  for (int x = static_cast<int>(std::floor(from)); x < to; ++x) {
    overlap.columns.push_back((x % width + width) % width);
    overlap.shares.push_back((std::min(x + 1.0, to) - std::max<double>(x, from)) / (to - from));
  }
  return overlap;
}

/// Source rows that are seen, and the most radiance that counts in each, by colour.
struct Source {
  const ColorPlanes& image;
  Band band;
  std::array<std::vector<float>, 3> most;

  Source(const ColorPlanes& image_in, int skipped, const PowerLimit& limit)
      : image(image_in), band(image_in.size.height, skipped) {
    for (int row = 0; row < band.count; ++row) {
      const double solid_angle = latlong_texel_solid_angle(image.size, band.first + row);
      for (size_t c = 0; c < 3; ++c) most[c].push_back(limit.radiance(c, solid_angle));
    }
  }
};

// Running sums over z of a column's share of the source: [band rows + 1].
std::vector<double> running_sums(const Source& source, size_t color, const Overlap& overlap) {
  const Band& band = source.band;
  const Plane& plane = *source.image.planes[color];
  std::vector<double> sums{0};
  sums.reserve(band.edges.size());
  for (int row = 0; row < band.count; ++row) {
    const auto at = static_cast<size_t>(row);
    const float* texels = plane.row(band.first + row);
    const float most = source.most[color][at];
    double value = 0;
    for (size_t i = 0; i < overlap.shares.size(); ++i) {
      value += overlap.shares[i] * std::clamp(texels[overlap.columns[i]], -most, most);
    }
    sums.push_back(fma(value, band.edges[at] - band.edges[at + 1], sums.back()));
  }
  return sums;
}

double sum_at(const std::vector<double>& sums, const Band& band, const Edge& edge) {
  const auto row = static_cast<size_t>(edge.row);
  const double top = band.edges[row], bottom = band.edges[row + 1];
  return lerp(sums[row], sums[row + 1], (top - edge.z) / (top - bottom));
}

/// What lies between two meridians: the edges of the texels there.
struct Strip {
  double from_u, to_u;  ///< [turn]
  const std::vector<Edge>& edges;
};

// Adds the power of a strip's texels, and how high they are, per unit of azimuth.
void add_strip(const Source& source, size_t color, const Strip& strip, std::vector<double>& power,
               std::vector<double>& heights) {
  const double width = strip.to_u - strip.from_u;
  const std::vector<double> sums =
      running_sums(source, color, overlap_of(source.image.size.width, strip.from_u, strip.to_u));
  double above = sum_at(sums, source.band, strip.edges[0]);
  for (size_t y = 0; y < power.size(); ++y) {
    const double below = sum_at(sums, source.band, strip.edges[y + 1]);
    power[y] += width * (below - above);
    heights[y] += width * (strip.edges[y].z - strip.edges[y + 1].z);
    above = below;
  }
}

void fill_column(const Source& source, const std::vector<Strip>& strips, int x, Layers& image) {
  for (size_t c = 0; c < 3; ++c) {
    Plane& plane = image.layers[c].plane;
    std::vector<double> power(static_cast<size_t>(plane.height())), heights(power.size());
    for (const Strip& strip : strips) add_strip(source, c, strip, power, heights);
    for (int y = 0; y < plane.height(); ++y) {
      const auto at = static_cast<size_t>(y);
      plane.at(x, y) = static_cast<float>(power[at] / heights[at]);
    }
  }
}

/// Runs fill(column) for each of `count` columns, neighbours on one thread.
template <class Fill>
void for_columns(int count, const Fill& fill) {
  for_rows((count + columns_at_once - 1) / columns_at_once, [&](int group) {
    const int end = std::min(count, (group + 1) * columns_at_once);
    for (int x = group * columns_at_once; x < end; ++x) fill(x);
  });
}

}  // namespace

void average_over_sides(const ColorPlanes& source, const PowerLimit& limit,
                        std::vector<Layers>& faces) {
  const int size = faces.front().size.width;
  const int strips_per_column = std::clamp(least_strips / size, 1, 8);
  const Source seen(source, source.size.height / 4, limit);
  for_columns(size, [&](int x) {
    std::vector<double> azimuths_rad;
    for (int i = 0; i <= strips_per_column; ++i) {
      const double s = 2 * (x + static_cast<double>(i) / strips_per_column) / size - 1;
      azimuths_rad.push_back(std::atan(s));
    }
    std::vector<std::vector<Edge>> edges;
    for (size_t i = 0; i + 1 < azimuths_rad.size(); ++i) {
      edges.push_back(edges_of_side(seen.band, size, azimuths_rad[i], azimuths_rad[i + 1]));
    }
    for (const Side& side : sides) {
      std::vector<Strip> strips;
      for (size_t i = 0; i < edges.size(); ++i) {
        strips.push_back({side.middle - azimuths_rad[i + 1] / (2 * pi),
                          side.middle - azimuths_rad[i] / (2 * pi), edges[i]});
      }
      fill_column(seen, strips, x, faces[static_cast<size_t>(side.face)]);
    }
  });
}

void average_over_latlong(const ColorPlanes& source, Layers& image) {
  const Size size = image.size;
  const Source seen(source, 0, {{INFINITY, INFINITY, INFINITY}});
  std::vector<double> heights;
  for (int j = 0; j <= size.height; ++j) heights.push_back(std::cos(pi * j / size.height));
  const std::vector<Edge> edges = edges_at(seen.band, heights);
  for_columns(size.width, [&](int x) {
    fill_column(seen, {{static_cast<double>(x) / size.width, (x + 1.0) / size.width, edges}}, x,
                image);
  });
}

}  // namespace kiln
