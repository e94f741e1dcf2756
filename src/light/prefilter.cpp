// SPDX-License-Identifier: Apache-2.0
#include "kiln/light/prefilter.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <span>

#include "finer.h"
#include "harmonic_synthesis.h"
#include "kiln/core/error.h"
#include "kiln/parallel/rows.h"
#include "lobe.h"

namespace kiln {
namespace {

// Energy that the cut of the sharpest lobe's expansion may neglect, as a root: the sharper, the
// less of a light is left in the expansion at all. Wider lobes spread what is neglected over more
// of the sphere, so they may neglect more.
constexpr double widest_cut_off = 3e-4;
double sharpest_cut_off(double alpha) { return std::clamp(1e-6 / alpha, 2e-5, 5e-5); }
// Share of the power above which a texel is left out of the expansion, in units of alpha^2 of the
// sharpest lobe: as much as makes that lobe's peak eight times the mean; and never more than this.
constexpr double hot_threshold = 2;
constexpr double hottest_share = 0.01;
// Where sin(theta)^m would underflow to no good, see LegendreColumn.
constexpr int highest_order = 1800;

/// Shares of a texel's power and how far from its centre they lie [texel].
struct Spread {
  std::vector<double> share, offset;
};

// The tent of linear interpolation as eight masses.
Spread spread_of(Across across) {
  if (across == Across::Nothing) return {{1}, {0}};
  Spread spread;
  for (int i = 0; i < 8; ++i) {
    spread.offset.push_back((i + 0.5) / 4 - 1);
    spread.share.push_back(0.25 * (1 - std::abs(spread.offset.back())));
  }
  return spread;
}

/// What the expansion leaves out. A texel whose share of a colour's power exceeds the limit would,
/// through the cut of the expansion, ring visibly around itself.
PointMasses masses_of(Size size, const std::vector<HotTexel>& texels, Across across) {
  const Spread spread = spread_of(across);
  const size_t parts = spread.share.size();
  PointMasses masses;
  masses.reset(texels.size() * parts);
  for (size_t i = 0; i < texels.size() * parts; ++i) {
    const HotTexel& texel = texels[i / parts];
    const double share = spread.share[i % parts];
    const Vec2<double> uv{(texel.x + 0.5 + spread.offset[i % parts]) / size.width,
                          (texel.y + 0.5) / size.height};
    masses.set(i, latlong_to_direction(uv),
               {share * texel.power[0], share * texel.power[1], share * texel.power[2], 0});
  }
  return masses;
}

bool any_negative(std::span<const float> values) {
  constexpr size_t lanes = lane_count<WideFloat>;
  WideFloat least(0.0f);
  size_t i = 0;
  for (; i + lanes <= values.size(); i += lanes) {
    least = min(least, load_lanes<WideFloat>(values.data() + i));
  }
  bool found = any(least < WideFloat(0.0f));
  for (; i < values.size(); ++i) found |= values[i] < 0;
  return found;
}

std::array<bool, 3> never_negative(const ColorPlanes& latlong) {
  const auto found = sum_rows(latlong.size.height, 3, [&](int y, std::vector<double>& negative) {
    for (size_t c = 0; c < 3; ++c) {
      negative[c] = any_negative(latlong.planes[c]->texels_of_row(y)) ? 1 : 0;
    }
  });
  return {found[0] == 0, found[1] == 0, found[2] == 0};
}

void check_lobes(const std::vector<FilterLobe>& lobes) {
  for (const FilterLobe& lobe : lobes) {
    if (lobe.alpha >= Prefilter::least_alpha && lobe.alpha <= 1) continue;
    throw Error(Fault::Usage,
                fmt::format("a lobe of alpha {:.3g} (roughness {:.3g}) is asked for; environments "
                            "are filtered with {} (roughness {:.3g}) to 1",
                            lobe.alpha, std::sqrt(lobe.alpha), Prefilter::least_alpha,
                            std::sqrt(Prefilter::least_alpha)));
  }
}

double sharpest_of(const std::vector<FilterLobe>& lobes) {
  double alpha = 1;
  for (const FilterLobe& lobe : lobes) alpha = std::min(alpha, lobe.alpha);
  return alpha;
}

int highest_of(const std::vector<ZonalKernel>& kernels) {
  int order = 0;
  for (const ZonalKernel& kernel : kernels) order = std::max(order, kernel.order());
  return order;
}

void divide(const std::vector<Layers>& by, std::vector<Layers>& images) {
  for (size_t i = 0; i < images.size(); ++i) {
    for_rows(images[i].size.height, [&](int y) {
      for (size_t c = 0; c < 3; ++c) {
        float* row = images[i].layers[c].plane.row(y);
        const float* divisor = by[i].layers[c].plane.row(y);
        for (int x = 0; x < images[i].size.width; ++x) row[x] /= divisor[x];
      }
    });
  }
}

}  // namespace

Refinement refinement_for(Size source, int order) {
  const auto times = [](int found, int needed) {
    return static_cast<int>(
        std::bit_ceil(static_cast<unsigned>(std::max(1, (needed + found - 1) / found))));
  };
  return {times(source.width, order + 1), times(source.height, (order + 1) / 2)};
}

struct Prefilter::Expanded {
  Layers finer_source;  ///< empty where the source itself is fine enough
  ColorPlanes source;
  std::vector<FilterLobe> lobes;
  std::vector<ZonalKernel> kernels;
  std::vector<LegendreColumn> columns;
  PointMasses hot;
  Expansion expansion;
  std::array<bool, 3> never_negative;
  Layers weights;  ///< plane W of the source, where it has one
  std::unique_ptr<Prefilter> of_weights;

  const ZonalKernel& kernel_of(const FilterLobe& lobe) const {
    const auto found = std::find(lobes.begin(), lobes.end(), lobe);
    if (found == lobes.end()) throw Error(Fault::Internal, "a lobe was not announced");
    return kernels[static_cast<size_t>(found - lobes.begin())];
  }

  /// What the convolution with the lobe and the texels left out of it make at a grid's samples.
  std::vector<Layers> at_samples(const FilterLobe& lobe, const SphereField& field,
                                 const SphereGrid& grid) const;
};

Prefilter::Prefilter(const Layers& latlong, const std::vector<FilterLobe>& lobes, Across across)
    : expanded_(std::make_unique<Expanded>()) {
  check_lobes(lobes);
  Expanded& made = *expanded_;
  made.lobes = lobes;
  made.kernels.resize(lobes.size());
  const double sharpest = sharpest_of(lobes);
  // Bands of the lobe itself; beyond these comes the edge that all lobes have at the horizon, for
  // which no source is made finer.
  const int bands = static_cast<int>(std::ceil(8 / sharpest));
  const int most = std::min(highest_order, std::max(bands, latlong.size.width - 1));
  for_rows(static_cast<int>(lobes.size()), [&](int i) {
    const FilterLobe& lobe = lobes[static_cast<size_t>(i)];
    made.kernels[static_cast<size_t>(i)] = expand_lobe(
        lobe,
        std::min(sharpest_cut_off(sharpest) * std::sqrt(lobe.alpha / sharpest), widest_cut_off),
        most);
  });
  const int order = highest_of(made.kernels);
  made.source = color_planes(latlong);
  const Refinement times = refinement_for(latlong.size, order);
  if (times.across * times.down > 1) {
    made.finer_source = finer(latlong, times);
    made.source = color_planes(made.finer_source);
  }
  made.columns = legendre_columns(order);
  const PowerLimit limit =
      share_of_power(made.source, std::min(hot_threshold * square(sharpest), hottest_share));
  made.hot = masses_of(made.source.size, hot_texels(made.source, limit), across);
  made.expansion = analyse(made.source, across, limit, made.columns);
  made.never_negative = never_negative(made.source);
  if (const Plane* weights = latlong.find("W")) {
    made.weights = {latlong.size, {{"Y", *weights}}};
    made.of_weights = std::make_unique<Prefilter>(made.weights, lobes);
  }
}

Size Prefilter::source_size() const { return expanded_->source.size; }

Prefilter::~Prefilter() = default;
Prefilter::Prefilter(Prefilter&&) noexcept = default;

double Prefilter::integral_of(const FilterLobe& lobe) const {
  return expanded_->kernel_of(lobe).integral;
}

std::vector<Layers> Prefilter::Expanded::at_samples(const FilterLobe& lobe,
                                                    const SphereField& field,
                                                    const SphereGrid& grid) const {
  const auto scale = static_cast<float>(1 / kernel_of(lobe).integral);
  const Size extent = grid.image_size();
  std::vector<Layers> images = blank_images(grid);
  for_rows(grid.images() * extent.height, [&](int row) {
    const int image = row / extent.height, y = row % extent.height;
    std::vector<Vec3<double>> directions;
    row_directions(grid, image, y, directions);
    std::vector<MassSums> smooth(directions.size()), sharp(directions.size(), MassSums{});
    field.evaluate(directions, smooth);
    add_masses(lobe, hot, directions, sharp);
    for (size_t c = 0; c < 3; ++c) {
      // Zero where a source without negative radiance came out below zero by rounding and the cut.
      const float least = never_negative[c] ? 0.0f : -INFINITY;
      float* to = images[static_cast<size_t>(image)].layers[c].plane.row(y);
      for (size_t x = 0; x < directions.size(); ++x) {
        to[x] = std::max(fma(sharp[x][c], scale, smooth[x][c]) / smooth[x][3], least);
      }
    }
  });
  if (of_weights) divide(of_weights->filter(lobe, grid), images);
  return images;
}

std::vector<std::vector<Layers>> Prefilter::filter_each(
    const FilterLobe& lobe, const std::vector<SphereGrid>& grids) const {
  const SphereField field =
      convolve(expanded_->expansion, expanded_->columns, expanded_->kernel_of(lobe));
  std::vector<std::vector<Layers>> filtered;
  filtered.reserve(grids.size());
  for (const SphereGrid& grid : grids) {
    filtered.push_back(expanded_->at_samples(lobe, field, grid));
  }
  return filtered;
}

std::vector<Layers> Prefilter::filter(const FilterLobe& lobe, const SphereGrid& grid) const {
  return std::move(filter_each(lobe, {grid}).front());
}

namespace {

/// Sines and cosines of the azimuths of texel centres.
struct Azimuths {
  std::vector<double> sine, cosine;

  explicit Azimuths(int width) {
    for (int x = 0; x < width; ++x) {
      const double azimuth_rad = 2 * pi * ((x + 0.5) / width - 0.5);
      sine.push_back(std::sin(azimuth_rad));
      cosine.push_back(std::cos(azimuth_rad));
    }
  }
};

/// A source and, where it has them, the point masses of the constant 1.
struct Weighed {
  const ColorPlanes& colors;
  const Plane* weights;
};

// Texels [begin, end) of a row, R G B and what the constant 1 weighs.
void take_row(const Weighed& source, const Azimuths& azimuths, int y, int begin, int end,
              PointMasses& masses) {
  const Size size = source.colors.size;
  const double theta = pi * (y + 0.5) / size.height;
  const double sine = std::sin(theta), cosine = std::cos(theta);
  const double solid_angle = latlong_texel_solid_angle(size, y);
  masses.reset(static_cast<size_t>(end - begin));
  for (int x = begin; x < end; ++x) {
    const auto at = static_cast<size_t>(x);
    const Vec3<double> power = source.colors.at(x, y) * solid_angle;
    const double one = source.weights ? source.weights->at(x, y) * solid_angle : solid_angle;
    masses.set(static_cast<size_t>(x - begin),
               {-azimuths.sine[at] * sine, cosine, azimuths.cosine[at] * sine},
               {power.x, power.y, power.z, one});
  }
}

/// Texels of one row, few enough that their sum in float keeps its digits.
struct Stretch {
  int y, begin, end;
};

// Whether the light of a stretch is above the horizon of d, or may be.
bool may_be_seen(const Vec3<double>& d, Size size, const Stretch& stretch) {
  const double middle = 0.5 * (stretch.begin + stretch.end) / size.width;
  const Vec3<double> toward =
      latlong_to_direction(Vec2<double>{middle, (stretch.y + 0.5) / size.height});
  const double half_rad = pi * (stretch.end - stretch.begin) / size.width;
  return dot(d, toward) > -std::sin(std::min(half_rad, 0.5 * pi));
}

// Adds what a probe finds in a stretch: R, G, B and weight for each of its directions.
void add_stretch(const LobeProbe& probe, Size size, const Stretch& stretch,
                 const PointMasses& masses, std::span<double> sums) {
  std::vector<Vec3<double>> seen;
  std::vector<size_t> which;
  for (size_t i = 0; i < probe.directions.size(); ++i) {
    if (!may_be_seen(probe.directions[i], size, stretch)) continue;
    seen.push_back(probe.directions[i]);
    which.push_back(i);
  }
  std::vector<MassSums> found(seen.size(), MassSums{});
  add_masses(probe.lobe, masses, seen, found);
  for (size_t k = 0; k < found.size(); ++k) {
    for (size_t c = 0; c < 4; ++c) sums[4 * which[k] + c] += found[k][c];
  }
}

}  // namespace

std::vector<std::vector<Vec3<double>>> Prefilter::brute_force(
    const std::vector<LobeProbe>& probes) const {
  const Size size = expanded_->source.size;
  const bool weighed = expanded_->of_weights && expanded_->weights.size == size;
  const Weighed source{expanded_->source,
                       weighed ? &expanded_->weights.layers.front().plane : nullptr};
  const Azimuths azimuths(size.width);
  const int texels_at_once = std::clamp(size.width / 16, 64, 1024);
  size_t count = 0;
  for (const LobeProbe& probe : probes) count += probe.directions.size();
  const auto add_row = [&](int y, std::vector<double>& row) {
    PointMasses masses;
    for (int begin = 0; begin < size.width; begin += texels_at_once) {
      const Stretch stretch{y, begin, std::min(begin + texels_at_once, size.width)};
      take_row(source, azimuths, y, stretch.begin, stretch.end, masses);
      std::span<double> rest(row);
      for (const LobeProbe& probe : probes) {
        add_stretch(probe, size, stretch, masses, rest);
        rest = rest.subspan(4 * probe.directions.size());
      }
    }
  };
  const auto sums = sum_rows(size.height, static_cast<int>(4 * count), add_row);
  std::vector<std::vector<Vec3<double>>> filtered(probes.size());
  size_t at = 0;
  for (size_t p = 0; p < probes.size(); ++p) {
    for (size_t i = 0; i < probes[p].directions.size(); ++i, at += 4) {
      filtered[p].push_back(Vec3<double>{sums[at], sums[at + 1], sums[at + 2]} *
                            (1 / sums[at + 3]));
    }
  }
  return filtered;
}

}  // namespace kiln
