// SPDX-License-Identifier: Apache-2.0
#include "fit.h"

#include <algorithm>
#include <cmath>

namespace kiln::validate {
namespace {

constexpr double greatest_share = 0.1;
constexpr double highest = 1.25;
constexpr double as_good_as_zero = 1e-8;  // there a table may hold what stands for a limit

// Fractions of a largest integer stop at 1, but for those over a divisor.
double ceiling_of(const Sheet& sheet) {
  using Stored = NumberArray::Stored;
  const Stored stored = sheet.array->stored;
  const bool fractions =
      stored == Stored::Uint8 || stored == Stored::Uint16 || stored == Stored::Rgb10a2 ||
      (stored == Stored::Integer && sheet.decoding.kind == Decoding::Kind::Scaled);
  return fractions && sheet.decoding.kind != Decoding::Kind::Rgbd ? 1 : Reading{}.ceiling;
}

std::vector<double> plane_of(Meaning meaning, const Reading& reading, const Grid& grid) {
  const size_t count = reading.mus.size();
  std::vector<double> plane(count * reading.alphas.size());
  const bool diffuse = grid.terms.empty();
  for (size_t i = 0; i < plane.size(); ++i) {
    plane[i] = value_of(meaning, diffuse ? Terms{} : grid.terms[i], reading.mus[i % count],
                        reading.alphas[i / count]);
    plane[i] = std::min(plane[i], reading.ceiling);
  }
  return plane;
}

bool reaches_zero(const std::vector<double>& values) {
  return *std::min_element(values.begin(), values.end()) < as_good_as_zero;
}

// Whether some entries may hold something beside the integral there.
bool has_limits(const Reading& reading, int model) {
  return model >= 0 && (reaches_zero(reading.alphas) || reaches_zero(reading.mus));
}

void take_nearer(double other, double stored, double& exact) {
  if (std::abs(other - stored) < std::abs(exact - stored)) exact = other;
}

// Rows of alpha = 0 take the mirror's entries where those are nearer to what is stored, columns of
// n.v = 0 those a little off.
void allow_limits(Meaning meaning, bool sheen, const Reading& reading, const Grid& grid,
                  const std::vector<double>& stored, std::vector<double>& plane) {
  const size_t count = reading.mus.size();
  for (size_t i = 0; i < plane.size(); ++i) {
    const double mu = reading.mus[i % count], alpha = reading.alphas[i / count];
    if (mu < as_good_as_zero) {
      take_nearer(value_of(meaning, grid.grazing[i / count], mu, alpha), stored[i], plane[i]);
    }
    if (alpha < as_good_as_zero && !sheen) {
      take_nearer(value_of(meaning, mirror_terms(mu), mu, alpha), stored[i], plane[i]);
    }
  }
}

// Cloth climbs steeply where it exceeds 1, and would drown what the other entries say.
double rms_between(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (size_t i = 0; i < a.size(); ++i) {
    const double error = std::min(a[i], highest) - std::min(b[i], highest);
    sum += error * error;
  }
  return std::sqrt(sum / static_cast<double>(a.size()));
}

}  // namespace

Places spread_places(const Sheet& sheet, bool transposed, int most) {
  const Size size = sheet.size();
  return {spread_indices(transposed ? size.height : size.width, most),
          spread_indices(transposed ? size.width : size.height, most)};
}

Values values_of(const Sheet& sheet, bool transposed, const Places& places) {
  if (!transposed) return values_at(sheet, places.cosines, places.widths);
  Values values = values_at(sheet, places.widths, places.cosines);
  const size_t w = places.widths.size(), h = places.cosines.size();
  std::vector<double> turned(w * h);
  for (std::vector<double>& channel : values) {
    for (size_t i = 0; i < w * h; ++i) turned[i % w * h + i / w] = channel[i];
    channel = turned;
  }
  return values;
}

Reading reading_of(const Sheet& sheet, bool transposed, const Places& places) {
  Reading reading;
  reading.values = values_of(sheet, transposed, places);
  reading.ceiling = ceiling_of(sheet);
  return reading;
}

std::vector<double> cosines_of(const Sheet& sheet, const TableAxes& axes, const Places& places) {
  if (sheet.is_curve()) return {1};
  const Size size = sheet.size();
  return positions(cosine_axis(axes), axes.transposed ? size.height : size.width, places.cosines);
}

std::vector<double> alphas_of(const Sheet& sheet, const TableAxes& axes, const Places& places) {
  const Size size = sheet.size();
  return positions(width_axis(axes), axes.transposed ? size.width : size.height, places.widths);
}

std::vector<ChannelFit> constant_channels(const Values& values) {
  std::vector<ChannelFit> fits(values.size());
  for (size_t c = 0; c < values.size(); ++c) {
    const auto [least, greatest] = std::minmax_element(values[c].begin(), values[c].end());
    if (*greatest - *least > 1e-6) continue;
    fits[c].constant = true;
    fits[c].level = *least;
    fits[c].rms = 0;
  }
  return fits;
}

void improve_fits(const Reading& reading, int model, const Grid& grid,
                  std::span<const Meaning> meanings, std::vector<ChannelFit>& fits) {
  const bool limits = has_limits(reading, model);
  for (const Meaning meaning : meanings) {
    const std::vector<double> plane = plane_of(meaning, reading, grid);
    std::vector<double> own;
    for (size_t c = 0; c < fits.size(); ++c) {
      if (fits[c].constant) continue;
      if (limits) {
        own = plane;
        allow_limits(meaning, tried_lobes()[model].sheen, reading, grid, reading.values[c], own);
      }
      const double rms = rms_between(limits ? own : plane, reading.values[c]);
      if (rms < fits[c].rms) fits[c] = {model, meaning, false, 0, rms};
    }
  }
}

std::vector<double> exact_entries(const ChannelFit& fit, const Reading& reading, int channel,
                                  const Grid& grid) {
  const std::vector<double>& stored = reading.values[channel];
  if (fit.constant) return std::vector<double>(stored.size(), fit.level);
  std::vector<double> plane = plane_of(fit.meaning, reading, grid);
  if (has_limits(reading, fit.model)) {
    allow_limits(fit.meaning, tried_lobes()[fit.model].sheen, reading, grid, stored, plane);
  }
  return plane;
}

double score_of(const std::vector<ChannelFit>& fits) {
  double sum = 0;
  int count = 0;
  for (const ChannelFit& fit : fits) {
    if (fit.constant) continue;
    sum += std::min(fit.rms, greatest_share);
    ++count;
  }
  return count == 0 ? greatest_share : sum / count;
}

}  // namespace kiln::validate
