// SPDX-License-Identifier: Apache-2.0
#include "harmonic_analysis.h"

#include "fourier.h"
#include "kiln/core/zeroed_allocator.h"
#include "kiln/image/projection.h"
#include "kiln/parallel/rows.h"

namespace kiln {
namespace {

constexpr int lanes = lane_count<WideDouble>;

/// For each m, colour and block of ring pairs: the Fourier coefficients of the pair's sum, which
/// meet the P_lm that are even about the equator, and of its difference, which meet the odd ones.
/// Blocks so near the poles that no P_lm of that m reaches them are left out.
struct RingSpectra {
  static constexpr size_t parts = 6;  ///< re, im of red, green, blue

  RingSpectra(const std::vector<LegendreColumn>& columns, const RingPairs& rings) {
    size_t count = 0;
    rows.reserve(columns.size());
    for (const LegendreColumn& column : columns) {
      const auto first = static_cast<size_t>(column.first_block(rings));
      rows.push_back({count, first, static_cast<size_t>(rings.blocks()) - first});
      count += parts * rows.back().blocks;
    }
    sums.resize(count);
    differences.resize(count);
  }

  /// Of one m: parts x blocks numbers from `begin` on.
  struct Row {
    size_t begin, first_block, blocks;
  };
  using Numbers = std::vector<WideDouble, ZeroedAllocator<WideDouble>>;

  std::vector<Row> rows;
  Numbers sums, differences;
};

/// What the rings of an image have in common.
struct Rings {
  const ColorPlanes& image;
  const PowerLimit& limit;
  RingPairs pairs;
  Fourier fourier;
  /// exp(-i m pi / width), from the first texel to its edge, times what interpolation leaves.
  std::vector<double> turn_re, turn_im;
};

double left_by(Across across, double half_texels_rad) {
  if (across == Across::Nothing || half_texels_rad == 0) return 1;
  return square(std::sin(half_texels_rad) / half_texels_rad);
}

Rings make_rings(const ColorPlanes& image, Across across, const PowerLimit& limit, int order) {
  Rings rings{image, limit, RingPairs(image.size.height), Fourier(image.size.width), {}, {}};
  for (int m = 0; m <= order; ++m) {
    const double half_texels_rad = pi * m / image.size.width;
    const double left = left_by(across, half_texels_rad);
    rings.turn_re.push_back(left * std::cos(half_texels_rad));
    rings.turn_im.push_back(-left * std::sin(half_texels_rad));
  }
  return rings;
}

// One lane: north + south as the real part, north - south as the imaginary.
void load_pair(const Rings& rings, int pair, size_t color, int lane, Spectrum& ring) {
  const Plane& plane = *rings.image.planes[color];
  const float* north = plane.row(pair);
  const float* south = plane.row(rings.image.size.height - 1 - pair);
  const double solid_angle = latlong_texel_solid_angle(rings.image.size, pair);
  const float most = rings.limit.radiance(color, solid_angle);
  const auto held = [most](float value) { return std::abs(value) > most ? 0.0f : value; };
  const double southern = rings.pairs.has_south(pair) ? solid_angle : 0.0;
  auto* re = reinterpret_cast<double*>(ring.re.data()) + lane;
  auto* im = reinterpret_cast<double*>(ring.im.data()) + lane;
  for (int x = 0; x < rings.image.size.width; ++x) {
    const double a = held(north[x]) * solid_angle, b = held(south[x]) * southern;
    re[x * lanes] = a + b;
    im[x * lanes] = a - b;
  }
}

// Separates the two real transforms and moves their origin to the edge of the image.
void store_block(const Rings& rings, const Spectrum& ring, size_t block, size_t color,
                 RingSpectra& spectra) {
  const size_t width = ring.re.size(), bands = rings.turn_re.size();
  const WideDouble half(0.5);
  for (size_t k = 0; k < bands; ++k) {
    const RingSpectra::Row& row = spectra.rows[k];
    if (block < row.first_block) continue;
    const size_t mirror = (width - k) % width;
    const WideDouble sum_re = half * (ring.re[k] + ring.re[mirror]);
    const WideDouble sum_im = half * (ring.im[k] - ring.im[mirror]);
    const WideDouble difference_re = half * (ring.im[k] + ring.im[mirror]);
    const WideDouble difference_im = half * (ring.re[mirror] - ring.re[k]);
    const WideDouble c(rings.turn_re[k]), s(rings.turn_im[k]);
    const size_t re = row.begin + 2 * color * row.blocks + (block - row.first_block);
    const size_t im = re + row.blocks;
    spectra.sums[re] = fma(sum_re, c, -(sum_im * s));
    spectra.sums[im] = fma(sum_re, s, sum_im * c);
    spectra.differences[re] = fma(difference_re, c, -(difference_im * s));
    spectra.differences[im] = fma(difference_re, s, difference_im * c);
  }
}

RingSpectra transform_rings(const Rings& rings, const std::vector<LegendreColumn>& columns) {
  RingSpectra spectra(columns, rings.pairs);
  for_rows(rings.pairs.blocks(), [&](int block) {
    Spectrum ring(rings.image.size.width), scratch;
    for (size_t color = 0; color < 3; ++color) {
      for (int lane = 0; lane < lanes; ++lane) {
        const int pair = block * lanes + lane;
        if (pair < rings.pairs.count) load_pair(rings, pair, color, lane, ring);
      }
      rings.fourier.forward(ring, scratch);
      store_block(rings, ring, static_cast<size_t>(block), color, spectra);
      std::fill(ring.re.begin(), ring.re.end(), WideDouble(0.0));
      std::fill(ring.im.begin(), ring.im.end(), WideDouble(0.0));
    }
  });
  return spectra;
}

/// P_l of four successive l on the rings from the column's first block on.
struct Sweep {
  static constexpr size_t rows = 4;
  std::array<std::vector<WideDouble>, rows> p;

  explicit Sweep(int blocks) {
    for (auto& row : p) row.assign(static_cast<size_t>(blocks), WideDouble(0.0));
  }
};

// P_l for i = l - m from `i` to i + 3; rows 2 and 3 hold the two before.
void advance(const LegendreColumn& column, const RingPairs& rings, size_t first, size_t i,
             Sweep& sweep) {
  const size_t last = column.scale.size() - 1;
  const auto at = [last](size_t k) { return std::min(k, last); };
  for (size_t v = first; v < sweep.p[0].size(); ++v) {
    const WideDouble x = rings.cosine[v], before = sweep.p[2][v], previous = sweep.p[3][v];
    const WideDouble a = i == 0 ? column.seed(rings.sine[v]) : column.next(i, x, previous, before);
    const WideDouble b = column.next(at(i + 1), x, a, i == 0 ? WideDouble(0.0) : previous);
    const WideDouble c = column.next(at(i + 2), x, b, a);
    sweep.p[0][v] = a;
    sweep.p[1][v] = b;
    sweep.p[2][v] = c;
    sweep.p[3][v] = column.next(at(i + 3), x, c, b);
  }
}

using Sums = std::array<WideDouble, RingSpectra::parts>;

ColorCoefficient added_up(const Sums& sums) {
  ColorCoefficient result;
  for (size_t k = 0; k < sums.size(); ++k) result[k] = xsimd::hadd(sums[k]);
  return result;
}

// Two rows of one parity against the six parts of a spectrum: the sums stay in registers.
std::array<ColorCoefficient, 2> project(const std::vector<WideDouble>& p,
                                        const std::vector<WideDouble>& q,
                                        const RingSpectra::Row& row,
                                        const RingSpectra::Numbers& spectra) {
  Sums of_p, of_q;
  of_p.fill(WideDouble(0.0));
  of_q.fill(WideDouble(0.0));
  for (size_t v = 0; v < row.blocks; ++v) {
    const WideDouble at_p = p[row.first_block + v], at_q = q[row.first_block + v];
    for (size_t k = 0; k < RingSpectra::parts; ++k) {
      const WideDouble part = spectra[row.begin + k * row.blocks + v];
      of_p[k] = fma(at_p, part, of_p[k]);
      of_q[k] = fma(at_q, part, of_q[k]);
    }
  }
  return {added_up(of_p), added_up(of_q)};
}

// P_lm is even about the equator where l + m is even, so it meets the pair's sum; else its
// difference.
std::vector<ColorCoefficient> analyse_column(const LegendreColumn& column, const RingPairs& rings,
                                             const RingSpectra& spectra) {
  const RingSpectra::Row& row = spectra.rows[static_cast<size_t>(column.m)];
  const size_t count = column.scale.size();
  Sweep sweep(rings.blocks());
  std::vector<ColorCoefficient> coefficients(count + Sweep::rows);
  for (size_t i = 0; i < count; i += Sweep::rows) {
    advance(column, rings, row.first_block, i, sweep);
    const auto even = project(sweep.p[0], sweep.p[2], row, spectra.sums);
    const auto odd = project(sweep.p[1], sweep.p[3], row, spectra.differences);
    coefficients[i] = even[0];
    coefficients[i + 1] = odd[0];
    coefficients[i + 2] = even[1];
    coefficients[i + 3] = odd[1];
  }
  coefficients.resize(count);
  return coefficients;
}

// The constant 1 has no other m as long as order < width; by symmetry no odd l either.
std::vector<double> analyse_constant(Size size, const RingPairs& rings,
                                     const LegendreColumn& column) {
  std::vector<WideDouble> weight, before(rings.sine.size(), WideDouble(0.0)), current = before;
  for (int block = 0; block < rings.blocks(); ++block) {
    double weights[lanes] = {};
    for (int lane = 0; lane < lanes; ++lane) {
      const int pair = block * lanes + lane;
      if (pair >= rings.count) continue;
      weights[lane] =
          latlong_texel_solid_angle(size, pair) * size.width * (rings.has_south(pair) ? 2 : 1);
    }
    weight.push_back(load_lanes<WideDouble>(weights));
  }
  std::vector<double> constant(column.scale.size());
  for (size_t l = 0; l < constant.size(); ++l) {
    WideDouble sum(0.0);
    for (size_t v = 0; v < weight.size(); ++v) {
      const WideDouble p = l == 0 ? column.seed(rings.sine[v])
                                  : column.next(l, rings.cosine[v], current[v], before[v]);
      before[v] = current[v];
      current[v] = p;
      sum = fma(p, weight[v], sum);
    }
    if (l % 2 == 0) constant[l] = xsimd::hadd(sum);
  }
  return constant;
}

}  // namespace

Expansion analyse(const ColorPlanes& latlong, Across across, const PowerLimit& limit,
                  const std::vector<LegendreColumn>& columns) {
  const int order = static_cast<int>(columns.size()) - 1;
  const Rings rings = make_rings(latlong, across, limit, order);
  const RingSpectra spectra = transform_rings(rings, columns);
  Expansion result{order, {}, analyse_constant(latlong.size, rings.pairs, columns.front())};
  result.columns.resize(columns.size());
  for_rows(order + 1, [&](int m) {
    const auto at = static_cast<size_t>(m);
    result.columns[at] = analyse_column(columns[at], rings.pairs, spectra);
  });
  return result;
}

}  // namespace kiln
