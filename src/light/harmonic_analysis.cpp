// SPDX-License-Identifier: Apache-2.0
#include "harmonic_analysis.h"

#include "fourier.h"
#include "kiln/image/projection.h"
#include "kiln/parallel/rows.h"
#include "legendre.h"

namespace kiln {
namespace {

constexpr int lanes = lane_count<WideDouble>;

/// For each m and ring pair, the Fourier coefficients of the pair's sum and difference.
struct RingSpectra {
  enum Part { SumRe, SumIm, DifferenceRe, DifferenceIm };
  static constexpr int parts = 4;

  RingSpectra(int order, const RingPairs& rings)
      : padded(static_cast<size_t>(rings.padded())),
        values(static_cast<size_t>(order + 1) * 3 * parts * padded) {}

  double* row(int m, int color, int part) {
    return values.data() + static_cast<size_t>((m * 3 + color) * parts + part) * padded;
  }
  const double* row(int m, int color, int part) const {
    return values.data() + static_cast<size_t>((m * 3 + color) * parts + part) * padded;
  }

  size_t padded;
  std::vector<double> values;
};

/// What the rings of an image have in common.
struct Rings {
  Size size;
  const std::vector<std::vector<double>>& radiance;
  RingPairs pairs;
  Fourier fourier;
  Spectrum half_texel;  ///< exp(-i m pi / width): from the first texel's centre to its edge
};

Spectrum half_texel_turns(int width, int order) {
  Spectrum turns(order + 1);
  for (int m = 0; m <= order; ++m) {
    turns.re[static_cast<size_t>(m)] = std::cos(pi * m / width);
    turns.im[static_cast<size_t>(m)] = -std::sin(pi * m / width);
  }
  return turns;
}

// One transform serves both rings: of (north + south) + i (north - south).
Spectrum transform_pair(const Rings& rings, int pair, int color) {
  const int width = rings.size.width, south = rings.size.height - 1 - pair;
  const std::vector<double>& upper = rings.radiance[static_cast<size_t>(pair)];
  const std::vector<double>& lower = rings.radiance[static_cast<size_t>(south)];
  const double solid_angle = latlong_texel_solid_angle(rings.size, pair);
  Spectrum ring(width);
  for (int x = 0; x < width; ++x) {
    const auto at = static_cast<size_t>(3 * x + color);
    const double a = upper[at], b = rings.pairs.has_south(pair) ? lower[at] : 0.0;
    ring.re[static_cast<size_t>(x)] = (a + b) * solid_angle;
    ring.im[static_cast<size_t>(x)] = (a - b) * solid_angle;
  }
  rings.fourier.forward(ring);
  return ring;
}

// Separates the two real transforms and moves their origin to the edge of the image.
void store_pair(const Spectrum& ring, const Spectrum& half_texel, int pair, int color,
                RingSpectra& spectra) {
  const size_t width = ring.re.size(), bands = half_texel.re.size();
  const auto at = static_cast<size_t>(pair);
  for (size_t k = 0; k < bands; ++k) {
    const auto m = static_cast<int>(k);
    const size_t mirror = (width - k) % width;
    const double sum_re = 0.5 * (ring.re[k] + ring.re[mirror]);
    const double sum_im = 0.5 * (ring.im[k] - ring.im[mirror]);
    const double difference_re = 0.5 * (ring.im[k] + ring.im[mirror]);
    const double difference_im = 0.5 * (ring.re[mirror] - ring.re[k]);
    const double c = half_texel.re[k], s = half_texel.im[k];
    spectra.row(m, color, RingSpectra::SumRe)[at] = sum_re * c - sum_im * s;
    spectra.row(m, color, RingSpectra::SumIm)[at] = sum_re * s + sum_im * c;
    spectra.row(m, color, RingSpectra::DifferenceRe)[at] = difference_re * c - difference_im * s;
    spectra.row(m, color, RingSpectra::DifferenceIm)[at] = difference_re * s + difference_im * c;
  }
}

RingSpectra transform_rings(const Rings& rings, int order) {
  RingSpectra spectra(order, rings.pairs);
  // A block at a time, so that no two threads write into one cache line.
  for_rows(rings.pairs.blocks, [&](int block) {
    const int end = std::min(rings.pairs.count, (block + 1) * lanes);
    for (int pair = block * lanes; pair < end; ++pair) {
      for (int color = 0; color < 3; ++color) {
        store_pair(transform_pair(rings, pair, color), rings.half_texel, pair, color, spectra);
      }
    }
  });
  return spectra;
}

// P_l and P_l-1 of one column on all rings.
struct Sweep {
  std::vector<double> current, previous;

  Sweep(const LegendreColumn& column, const RingPairs& rings, int first)
      : current(static_cast<size_t>(rings.padded())), previous(current.size()) {
    for (int v = first; v < rings.blocks; ++v) {
      store_lanes(current.data() + v * lanes, column.seed(rings, v));
    }
  }
};

void step(Sweep& sweep, const RingPairs& rings, int first, double scale, double back) {
  for (int at = first * lanes; at < rings.padded(); at += lanes) {
    const WideDouble p = load_lanes<WideDouble>(sweep.current.data() + at);
    const WideDouble q = load_lanes<WideDouble>(sweep.previous.data() + at);
    const WideDouble x = load_lanes<WideDouble>(rings.cosine.data() + at);
    store_lanes(sweep.previous.data() + at, fma(WideDouble(scale) * x, p, -(WideDouble(back) * q)));
  }
  std::swap(sweep.current, sweep.previous);
}

// P_lm is even about the equator where l + m is even, so it meets the pair's sum; else its
// difference.
ColorCoefficient project(const Sweep& sweep, const RingSpectra& spectra, int m, int first,
                         int part) {
  ColorCoefficient result;
  const auto end = static_cast<int>(sweep.current.size());
  const double* re[3];
  const double* im[3];
  WideDouble sum_re[3], sum_im[3];
  for (int c = 0; c < 3; ++c) {
    re[c] = spectra.row(m, c, part);
    im[c] = spectra.row(m, c, part + 1);
    sum_re[c] = sum_im[c] = WideDouble(0.0);
  }
  for (int at = first * lanes; at < end; at += lanes) {
    const WideDouble p = load_lanes<WideDouble>(sweep.current.data() + at);
    for (int c = 0; c < 3; ++c) {
      sum_re[c] = fma(p, load_lanes<WideDouble>(re[c] + at), sum_re[c]);
      sum_im[c] = fma(p, load_lanes<WideDouble>(im[c] + at), sum_im[c]);
    }
  }
  for (size_t c = 0; c < 3; ++c) {
    result.re[c] = xsimd::hadd(sum_re[c]);
    result.im[c] = xsimd::hadd(sum_im[c]);
  }
  return result;
}

std::vector<ColorCoefficient> analyse_column(const RingPairs& rings, const RingSpectra& spectra,
                                             int m, int order) {
  const LegendreColumn column(m, order);
  const int first = column.first_block(rings);
  Sweep sweep(column, rings, first);
  std::vector<ColorCoefficient> coefficients(static_cast<size_t>(order + 1 - m));
  for (size_t i = 0; i < coefficients.size(); ++i) {
    if (i > 0) step(sweep, rings, first, column.scale[i], column.back[i]);
    const int part = i % 2 == 0 ? RingSpectra::SumRe : RingSpectra::DifferenceRe;
    coefficients[i] = project(sweep, spectra, m, first, part);
  }
  return coefficients;
}

// The constant 1 has no other m as long as order < width; by symmetry no odd l either.
std::vector<double> analyse_constant(Size size, const RingPairs& rings, int order) {
  const LegendreColumn column(0, order);
  Sweep sweep(column, rings, 0);
  std::vector<double> constant(static_cast<size_t>(order) + 1);
  for (size_t l = 0; l < constant.size(); ++l) {
    if (l > 0) step(sweep, rings, 0, column.scale[l], column.back[l]);
    if (l % 2 == 1) continue;
    for (int pair = 0; pair < rings.count; ++pair) {
      const double ring = latlong_texel_solid_angle(size, pair) * size.width;
      constant[l] +=
          sweep.current[static_cast<size_t>(pair)] * ring * (rings.has_south(pair) ? 2 : 1);
    }
  }
  return constant;
}

}  // namespace

Expansion analyse(Size size, const std::vector<std::vector<double>>& radiance, int order) {
  const Rings rings{size, radiance, RingPairs(size.height), Fourier(size.width),
                    half_texel_turns(size.width, order)};
  const RingSpectra spectra = transform_rings(rings, order);
  Expansion result{order, {}, analyse_constant(size, rings.pairs, order)};
  result.columns.resize(static_cast<size_t>(order) + 1);
  for_rows(order + 1, [&](int m) {
    result.columns[static_cast<size_t>(m)] = analyse_column(rings.pairs, spectra, m, order);
  });
  return result;
}

}  // namespace kiln
