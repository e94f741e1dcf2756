// SPDX-License-Identifier: Apache-2.0
#include "harmonic_synthesis.h"

#include <bit>

#include "fourier.h"
#include "kiln/parallel/rows.h"
#include "legendre.h"

namespace kiln {
namespace {

constexpr int lanes = lane_count<WideDouble>;

// Rows of the grid per band: at 1.5 the 8-point interpolation of the highest wave errs by 2 %, and
// the kernel has damped it to 1e-4 by then.
constexpr double rows_per_band = 1.5;
constexpr int smallest_grid = 32;

int rows_for(int order) {
  const auto needed = static_cast<unsigned>(std::ceil(rows_per_band * (order + 1)));
  return static_cast<int>(std::bit_ceil(std::max(needed, static_cast<unsigned>(smallest_grid))));
}

/// For each m, color and ring pair: the part of the sum that is even about the equator, and odd.
struct RingSums {
  enum Part { EvenRe, EvenIm, OddRe, OddIm };
  static constexpr int parts = 4;

  RingSums(int order, const RingPairs& rings)
      : padded(static_cast<size_t>(rings.padded())),
        values(static_cast<size_t>(order + 1) * 3 * parts * padded) {}

  double* row(int m, int color, int part) {
    return values.data() + static_cast<size_t>((m * 3 + color) * parts + part) * padded;
  }
  double value(int m, int color, int part, int pair) const {
    return values[static_cast<size_t>((m * 3 + color) * parts + part) * padded +
                  static_cast<size_t>(pair)];
  }

  size_t padded;
  std::vector<double> values;
};

/// One column of the expansion times the kernel.
std::vector<ColorCoefficient> damped(const std::vector<ColorCoefficient>& column,
                                     const ZonalKernel& kernel, int m) {
  std::vector<ColorCoefficient> result(static_cast<size_t>(kernel.order() + 1 - m));
  for (size_t i = 0; i < result.size(); ++i) {
    const double factor = kernel.factor[i + static_cast<size_t>(m)];
    for (size_t c = 0; c < 3; ++c) {
      result[i].re[c] = factor * column[i].re[c];
      result[i].im[c] = factor * column[i].im[c];
    }
  }
  return result;
}

/// Sums of one column on one block of rings; index 2 * color + (0 re, 1 im).
struct BlockSums {
  std::array<WideDouble, 6> even, odd;
};

void add_term(const ColorCoefficient& coefficient, WideDouble p, std::array<WideDouble, 6>& sums) {
  for (size_t c = 0; c < 3; ++c) {
    sums[2 * c] = fma(p, WideDouble(coefficient.re[c]), sums[2 * c]);
    sums[2 * c + 1] = fma(p, WideDouble(coefficient.im[c]), sums[2 * c + 1]);
  }
}

BlockSums sum_block(const LegendreColumn& column, const RingPairs& rings, int block,
                    const std::vector<ColorCoefficient>& coefficients) {
  BlockSums sums;
  sums.even.fill(WideDouble(0.0));
  sums.odd.fill(WideDouble(0.0));
  const WideDouble x = load_lanes<WideDouble>(rings.cosine.data() + block * lanes);
  WideDouble p = column.seed(rings, block), q(0.0);
  for (size_t i = 0; i < coefficients.size(); i += 2) {
    add_term(coefficients[i], p, sums.even);
    if (i + 1 == coefficients.size()) break;
    q = fma(WideDouble(column.scale[i + 1]) * x, p, -(WideDouble(column.back[i + 1]) * q));
    add_term(coefficients[i + 1], q, sums.odd);
    if (i + 2 == coefficients.size()) break;
    p = fma(WideDouble(column.scale[i + 2]) * x, q, -(WideDouble(column.back[i + 2]) * p));
  }
  return sums;
}

void sum_column(const Expansion& expansion, const ZonalKernel& kernel, const RingPairs& rings,
                int m, RingSums& sums) {
  const LegendreColumn column(m, kernel.order());
  const auto coefficients = damped(expansion.columns[static_cast<size_t>(m)], kernel, m);
  for (int block = column.first_block(rings); block < rings.blocks; ++block) {
    const BlockSums found = sum_block(column, rings, block, coefficients);
    for (int c = 0; c < 3; ++c) {
      const auto at = static_cast<size_t>(2 * c);
      store_lanes(sums.row(m, c, RingSums::EvenRe) + block * lanes, found.even[at]);
      store_lanes(sums.row(m, c, RingSums::EvenIm) + block * lanes, found.even[at + 1]);
      store_lanes(sums.row(m, c, RingSums::OddRe) + block * lanes, found.odd[at]);
      store_lanes(sums.row(m, c, RingSums::OddIm) + block * lanes, found.odd[at + 1]);
    }
  }
}

// One inverse transform serves both rings: of north + i south, whose parts are real.
Spectrum rings_of_pair(const RingSums& sums, const Fourier& fourier, int order, int pair, int c) {
  const auto width = static_cast<size_t>(fourier.length());
  Spectrum ring(fourier.length());
  for (int m = 0; m <= order; ++m) {
    const double even_re = sums.value(m, c, RingSums::EvenRe, pair);
    const double even_im = sums.value(m, c, RingSums::EvenIm, pair);
    const double odd_re = sums.value(m, c, RingSums::OddRe, pair);
    const double odd_im = sums.value(m, c, RingSums::OddIm, pair);
    // From the edge of the image back to the first texel's centre.
    const double angle = pi * m / static_cast<double>(width);
    const double cosine = std::cos(angle), sine = std::sin(angle);
    const auto turned = [&](double re, double im) {
      return Vec2<double>{re * cosine - im * sine, re * sine + im * cosine};
    };
    const Vec2<double> north = turned(even_re + odd_re, even_im + odd_im);
    const Vec2<double> south = turned(even_re - odd_re, even_im - odd_im);
    const auto k = static_cast<size_t>(m);
    ring.re[k] = north.x - south.y;
    ring.im[k] = north.y + south.x;
    if (m == 0) continue;
    ring.re[width - k] = north.x + south.y;
    ring.im[width - k] = south.x - north.y;
  }
  fourier.inverse(ring);
  return ring;
}

/// The convolution of the constant 1, by ring pair.
std::vector<double> constant_on_rings(const Expansion& expansion, const ZonalKernel& kernel,
                                      const RingPairs& rings) {
  const LegendreColumn column(0, kernel.order());
  std::vector<double> result(static_cast<size_t>(rings.count));
  for (size_t pair = 0; pair < result.size(); ++pair) {
    double p = column.seed_factor, q = 0;
    for (size_t l = 0; l < kernel.factor.size(); ++l) {
      if (l > 0) {
        const double next = column.scale[l] * rings.cosine[pair] * p - column.back[l] * q;
        q = p;
        p = next;
      }
      result[pair] += kernel.factor[l] * expansion.constant[l] * p;
    }
  }
  return result;
}

}  // namespace

SphereField convolve(const Expansion& expansion, const ZonalKernel& kernel) {
  SphereField field(rows_for(kernel.order()));
  const RingPairs rings(field.height());
  RingSums sums(kernel.order(), rings);
  for_rows(kernel.order() + 1, [&](int m) { sum_column(expansion, kernel, rings, m, sums); });

  const Fourier fourier(field.width());
  const std::vector<double> constant = constant_on_rings(expansion, kernel, rings);
  for_rows(rings.count, [&](int pair) {
    const int south = field.height() - 1 - pair;
    for (int c = 0; c < 3; ++c) {
      const Spectrum ring = rings_of_pair(sums, fourier, kernel.order(), pair, c);
      for (int x = 0; x < field.width(); ++x) {
        field.texel(x, pair)[c] = static_cast<float>(ring.re[static_cast<size_t>(x)]);
        field.texel(x, south)[c] = static_cast<float>(ring.im[static_cast<size_t>(x)]);
      }
    }
    for (int x = 0; x < field.width(); ++x) {
      const auto value = static_cast<float>(constant[static_cast<size_t>(pair)]);
      field.texel(x, pair)[3] = field.texel(x, south)[3] = value;
    }
  });
  field.fill_border();
  return field;
}

}  // namespace kiln
