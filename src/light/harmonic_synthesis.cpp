// SPDX-License-Identifier: Apache-2.0
#include "harmonic_synthesis.h"

#include <bit>

#include "fourier.h"
#include "kiln/parallel/rows.h"

namespace kiln {
namespace {

constexpr int lanes = lane_count<WideDouble>;

// Rows of the grid per band: at 1.4 the 8-point interpolation of the highest wave errs by 3 %, and
// the kernel has damped it to 1e-4 by then.
constexpr double rows_per_band = 1.4;
constexpr int smallest_grid = 32;

int rows_for(int order) {
  const auto needed = static_cast<unsigned>(std::ceil(rows_per_band * (order + 1)));
  return static_cast<int>(std::bit_ceil(std::max(needed, static_cast<unsigned>(smallest_grid))));
}

/// The expansion times the kernel, column by column.
using Damped = std::vector<std::vector<ColorCoefficient>>;

Damped damped(const Expansion& expansion, const ZonalKernel& kernel) {
  Damped result(kernel.factor.size());
  for_rows(static_cast<int>(result.size()), [&](int row) {
    const auto m = static_cast<size_t>(row);
    const auto& column = expansion.columns[m];
    result[m].assign(column.begin(),
                     column.begin() + static_cast<std::ptrdiff_t>(result.size() - m));
    for (size_t i = 0; i < result[m].size(); ++i) {
      for (double& part : result[m][i]) part *= kernel.factor[i + m];
    }
  });
  return result;
}

/// Two blocks of ring pairs at once: sums of a column over even or odd l - m, by part.
struct BlockSums {
  std::array<WideDouble, 6> near, far;
};

// Every other row of p, two wide numbers each, against every other coefficient.
BlockSums sum_every_other(const std::vector<WideDouble>& p,
                          const std::vector<ColorCoefficient>& coefficients, size_t first) {
  BlockSums sums;
  sums.near.fill(WideDouble(0.0));
  sums.far.fill(WideDouble(0.0));
  for (size_t i = first; i < coefficients.size(); i += 2) {
    const WideDouble near = p[2 * i], far = p[2 * i + 1];
    for (size_t k = 0; k < 6; ++k) {
      const WideDouble part(coefficients[i][k]);
      sums.near[k] = fma(near, part, sums.near[k]);
      sums.far[k] = fma(far, part, sums.far[k]);
    }
  }
  return sums;
}

// P_l of the column on two blocks of rings.
void fill_polynomials(const LegendreColumn& column, const RingPairs& rings, size_t block,
                      size_t count, std::vector<WideDouble>& p) {
  const size_t next_block = std::min(block + 1, rings.sine.size() - 1);
  const WideDouble near = rings.cosine[block], far = rings.cosine[next_block];
  WideDouble a = column.seed(rings.sine[block]), b = column.seed(rings.sine[next_block]);
  WideDouble before_a(0.0), before_b(0.0);
  p[0] = a;
  p[1] = b;
  for (size_t i = 1; i < count; ++i) {
    const WideDouble next_a = column.next(i, near, a, before_a);
    const WideDouble next_b = column.next(i, far, b, before_b);
    before_a = a;
    before_b = b;
    a = next_a;
    b = next_b;
    p[2 * i] = a;
    p[2 * i + 1] = b;
  }
}

/// Rings of one block: spectra of three colours of north + i south, whose parts are real.
using BlockSpectra = std::array<Spectrum, 3>;

void add_column(const std::array<WideDouble, 6>& even, const std::array<WideDouble, 6>& odd,
                size_t m, BlockSpectra& spectra) {
  const size_t width = spectra[0].re.size();
  // From the edge of the image back to the first texel's centre.
  const double angle = pi * static_cast<double>(m) / static_cast<double>(width);
  const WideDouble cosine(std::cos(angle)), sine(std::sin(angle));
  for (size_t c = 0; c < 3; ++c) {
    const WideDouble re_north = even[2 * c] + odd[2 * c], re_south = even[2 * c] - odd[2 * c];
    const WideDouble im_north = even[2 * c + 1] + odd[2 * c + 1];
    const WideDouble im_south = even[2 * c + 1] - odd[2 * c + 1];
    const WideDouble north_re = re_north * cosine - im_north * sine;
    const WideDouble north_im = re_north * sine + im_north * cosine;
    const WideDouble south_re = re_south * cosine - im_south * sine;
    const WideDouble south_im = re_south * sine + im_south * cosine;
    spectra[c].re[m] = north_re - south_im;
    spectra[c].im[m] = north_im + south_re;
    if (m == 0) continue;
    spectra[c].re[width - m] = north_re + south_im;
    spectra[c].im[width - m] = south_re - north_im;
  }
}

/// The convolution of the constant 1, by block.
std::vector<WideDouble> constant_on_rings(const Expansion& expansion, const LegendreColumn& column,
                                          const ZonalKernel& kernel, const RingPairs& rings) {
  std::vector<WideDouble> result;
  for (size_t block = 0; block < rings.sine.size(); ++block) {
    WideDouble p = column.seed(rings.sine[block]), before(0.0), sum(0.0);
    for (size_t l = 0; l < kernel.factor.size(); ++l) {
      if (l > 0) {
        const WideDouble next = column.next(l, rings.cosine[block], p, before);
        before = p;
        p = next;
      }
      sum = fma(p, WideDouble(kernel.factor[l] * expansion.constant[l]), sum);
    }
    result.push_back(sum);
  }
  return result;
}

// A block of ring pairs out of its spectra.
void store_block(const RingPairs& rings, int block, size_t color, const Spectrum& ring,
                 SphereField& field) {
  double north[lanes], south[lanes];
  const int count = std::min(lanes, rings.count - block * lanes);
  for (int x = 0; x < field.width(); ++x) {
    const auto at = static_cast<size_t>(x);
    store_lanes(north, ring.re[at]);
    store_lanes(south, ring.im[at]);
    for (int lane = 0; lane < count; ++lane) {
      const int pair = block * lanes + lane;
      field.texel(x, pair)[color] = static_cast<float>(north[lane]);
      field.texel(x, field.height() - 1 - pair)[color] = static_cast<float>(south[lane]);
    }
  }
}

/// Everything that turns coefficients into rings.
struct Synthesis {
  const std::vector<LegendreColumn>& columns;
  Damped coefficients;
  RingPairs rings;
  Fourier fourier;
  std::vector<WideDouble> constant;
};

void store_constant(const Synthesis& synthesis, int block, SphereField& field) {
  for (int lane = 0; lane < lanes; ++lane) {
    const int pair = block * lanes + lane;
    if (pair >= synthesis.rings.count) return;
    const auto value = static_cast<float>(
        synthesis.constant[static_cast<size_t>(block)].get(static_cast<size_t>(lane)));
    for (int x = 0; x < field.width(); ++x) {
      field.texel(x, pair)[3] = field.texel(x, field.height() - 1 - pair)[3] = value;
    }
  }
}

void fill_two_blocks(const Synthesis& synthesis, int first, SphereField& field) {
  const int count = std::min(2, synthesis.rings.blocks() - first);
  std::array<BlockSpectra, 2> spectra;
  for (BlockSpectra& block : spectra) block.fill(Spectrum(field.width()));
  std::vector<WideDouble> p(2 * synthesis.coefficients.size());
  for (size_t m = 0; m < synthesis.coefficients.size(); ++m) {
    const LegendreColumn& column = synthesis.columns[m];
    const auto& coefficients = synthesis.coefficients[m];
    if (column.vanishes_at(synthesis.rings, first + count - 1, synthesis.coefficients.size())) {
      break;
    }
    fill_polynomials(column, synthesis.rings, static_cast<size_t>(first), coefficients.size(), p);
    const BlockSums even = sum_every_other(p, coefficients, 0);
    const BlockSums odd = sum_every_other(p, coefficients, 1);
    add_column(even.near, odd.near, m, spectra[0]);
    if (count > 1) add_column(even.far, odd.far, m, spectra[1]);
  }
  Spectrum scratch;
  for (int i = 0; i < count; ++i) {
    for (size_t c = 0; c < 3; ++c) {
      Spectrum& ring = spectra[static_cast<size_t>(i)][c];
      synthesis.fourier.inverse(ring, scratch);
      store_block(synthesis.rings, first + i, c, ring, field);
    }
    store_constant(synthesis, first + i, field);
  }
}

}  // namespace

SphereField convolve(const Expansion& expansion, const std::vector<LegendreColumn>& columns,
                     const ZonalKernel& kernel) {
  SphereField field(rows_for(kernel.order()));
  RingPairs rings(field.height());
  std::vector<WideDouble> constant = constant_on_rings(expansion, columns.front(), kernel, rings);
  const Synthesis synthesis{columns, damped(expansion, kernel), std::move(rings),
                            Fourier(field.width()), std::move(constant)};
  for_rows((synthesis.rings.blocks() + 1) / 2,
           [&](int two) { fill_two_blocks(synthesis, 2 * two, field); });
  field.fill_border();
  return field;
}

}  // namespace kiln
