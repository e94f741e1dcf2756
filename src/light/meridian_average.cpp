// SPDX-License-Identifier: Apache-2.0
#include "meridian_average.h"

#include <algorithm>
#include <array>

#include "kiln/core/zeroed_allocator.h"
#include "kiln/image/projection.h"
#include "kiln/parallel/rows.h"

namespace kiln {
namespace {

constexpr int rows_at_once = 16;
// Strips of a side face between two meridians, in each of which edges between texels are level.
constexpr int least_strips = 256;
constexpr int most_strips_per_column = 16;

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
  std::vector<float> shares;
};

Overlap overlap_of(int width, double from_u, double to_u) {
  const double from = from_u * width, to = to_u * width;
  Overlap overlap;
  for (int x = static_cast<int>(std::floor(from)); x < to; ++x) {
    overlap.columns.push_back((x % width + width) % width);
    overlap.shares.push_back(
        static_cast<float>((std::min(x + 1.0, to) - std::max<double>(x, from)) / (to - from)));
  }
  return overlap;
}

/// A source and the rows of it that are seen.
struct Source {
  const ColorPlanes& image;
  Band band;
};

/// What lies between two meridians: the edges of the texels there.
struct Strip {
  double from_u, to_u;  ///< [turn]
  const std::vector<Edge>& edges;
};

/// The source as it is seen in strips: [color][strip][row of the band].
struct StripRows {
  size_t rows = 0;
  std::array<std::vector<float, ZeroedAllocator<float>>, 3> values;

  const float* of(size_t color, size_t strip) const { return values[color].data() + strip * rows; }
};

// A few rows of the source at a time, so that each is read once, and whole lines are written.
StripRows seen_in(const Source& source, const std::vector<Strip>& strips) {
  std::vector<Overlap> overlaps;
  overlaps.reserve(strips.size());
  for (const Strip& strip : strips) {
    overlaps.push_back(overlap_of(source.image.size.width, strip.from_u, strip.to_u));
  }
  StripRows seen{static_cast<size_t>(source.band.count), {}};
  for (auto& values : seen.values) values.resize(strips.size() * seen.rows);
  const int blocks = (source.band.count + rows_at_once - 1) / rows_at_once;
  for_rows(3 * blocks, [&](int task) {
    const auto c = static_cast<size_t>(task / blocks);
    const int first = task % blocks * rows_at_once;
    const int end = std::min(first + rows_at_once, source.band.count);
    for (size_t strip = 0; strip < overlaps.size(); ++strip) {
      float* to = seen.values[c].data() + strip * seen.rows;
      for (int row = first; row < end; ++row) {
        const float* texels = source.image.planes[c]->row(source.band.first + row);
        float value = 0;
        for (size_t i = 0; i < overlaps[strip].shares.size(); ++i) {
          value = fma(overlaps[strip].shares[i], texels[overlaps[strip].columns[i]], value);
        }
        to[row] = value;
      }
    }
  });
  return seen;
}

// Running sums over z: [rows + 1].
void sum_up(const float* values, const Band& band, std::vector<double>& sums) {
  sums.resize(band.edges.size());
  sums[0] = 0;
  for (size_t row = 0; row + 1 < band.edges.size(); ++row) {
    sums[row + 1] = fma(values[row], band.edges[row] - band.edges[row + 1], sums[row]);
  }
}

double sum_at(const std::vector<double>& sums, const Band& band, const Edge& edge) {
  const auto row = static_cast<size_t>(edge.row);
  const double top = band.edges[row], bottom = band.edges[row + 1];
  return lerp(sums[row], sums[row + 1], (top - edge.z) / (top - bottom));
}

/// Columns of images, each of the same number of strips.
struct Columns {
  struct Column {
    Layers* image;
    int x;
  };
  std::vector<Column> columns;
  std::vector<Strip> strips;  ///< of the first column, of the second, ...
};

// The power of a column's texels over how high they are.
void fill_column(const Band& band, const Columns& columns, const StripRows& seen, size_t column) {
  const size_t count = columns.strips.size() / columns.columns.size();
  const auto [image, x] = columns.columns[column];
  std::vector<double> sums, power, heights;
  for (size_t c = 0; c < 3; ++c) {
    Plane& plane = image->layers[c].plane;
    power.assign(static_cast<size_t>(plane.height()), 0.0);
    heights = power;
    for (size_t i = column * count; i < (column + 1) * count; ++i) {
      const Strip& strip = columns.strips[i];
      const double width = strip.to_u - strip.from_u;
      sum_up(seen.of(c, i), band, sums);
      double above = sum_at(sums, band, strip.edges[0]);
      for (size_t y = 0; y < power.size(); ++y) {
        const double below = sum_at(sums, band, strip.edges[y + 1]);
        power[y] += width * (below - above);
        heights[y] += width * (strip.edges[y].z - strip.edges[y + 1].z);
        above = below;
      }
    }
    for (int y = 0; y < plane.height(); ++y) {
      const auto at = static_cast<size_t>(y);
      plane.at(x, y) = static_cast<float>(power[at] / heights[at]);
    }
  }
}

void fill_columns(const Source& source, const Columns& columns) {
  const StripRows seen = seen_in(source, columns.strips);
  for_rows(static_cast<int>(columns.columns.size()), [&](int column) {
    fill_column(source.band, columns, seen, static_cast<size_t>(column));
  });
}

/// The strips of a side face's columns, with what all four faces have in common.
struct SideStrips {
  std::vector<double> azimuths_rad;      ///< of the face, one more than there are strips
  std::vector<std::vector<Edge>> edges;  ///< of each strip
};

// About as narrow as the source's columns: then what the edge to the top and bottom faces cuts off
// a texel is right, though it is level in each strip.
SideStrips strips_of_side(const Band& band, int size, int source_columns) {
  const int wanted = std::max(least_strips, source_columns / 8);
  const int count = size * std::clamp((wanted + size - 1) / size, 1, most_strips_per_column);
  SideStrips strips;
  for (int i = 0; i <= count; ++i) strips.azimuths_rad.push_back(std::atan(2.0 * i / count - 1));
  strips.edges.resize(static_cast<size_t>(count));
  for_rows(count, [&](int i) {
    const auto at = static_cast<size_t>(i);
    strips.edges[at] =
        edges_of_side(band, size, strips.azimuths_rad[at], strips.azimuths_rad[at + 1]);
  });
  return strips;
}

}  // namespace

void average_over_sides(const ColorPlanes& source, double turns, std::vector<Layers>& faces) {
  const int size = faces.front().size.width;
  const Source seen{source, Band(source.size.height, source.size.height / 4)};
  const SideStrips strips = strips_of_side(seen.band, size, source.size.width);
  Columns columns;
  for (const Side& side : sides) {
    for (int x = 0; x < size; ++x) {
      columns.columns.push_back({&faces[static_cast<size_t>(side.face)], x});
    }
    for (size_t i = 0; i < strips.edges.size(); ++i) {
      columns.strips.push_back({side.middle + turns - strips.azimuths_rad[i + 1] / (2 * pi),
                                side.middle + turns - strips.azimuths_rad[i] / (2 * pi),
                                strips.edges[i]});
    }
  }
  fill_columns(seen, columns);
}

void average_over_latlong(const ColorPlanes& source, double turns, Layers& image) {
  const Size size = image.size;
  const Source seen{source, Band(source.size.height, 0)};
  std::vector<double> heights;
  for (int j = 0; j <= size.height; ++j) heights.push_back(std::cos(pi * j / size.height));
  const std::vector<Edge> edges = edges_at(seen.band, heights);
  Columns columns;
  for (int x = 0; x < size.width; ++x) {
    columns.columns.push_back({&image, x});
    columns.strips.push_back(
        {turns + static_cast<double>(x) / size.width, turns + (x + 1.0) / size.width, edges});
  }
  fill_columns(seen, columns);
}

}  // namespace kiln
