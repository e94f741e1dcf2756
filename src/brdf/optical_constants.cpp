// SPDX-License-Identifier: Apache-2.0
#include "kiln/brdf/optical_constants.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "kiln/brdf/conductor.h"
#include "kiln/core/error.h"

namespace kiln {
namespace {

constexpr int first_nm = 380, last_nm = 780, step_nm = 10;

// Relative power of the CIE illuminant D65, 380 to 780 nm by 10.
constexpr std::array daylight = {49.9755, 54.6482, 82.7549, 91.4860, 93.4318, 86.6823, 104.865,
                                 117.008, 117.812, 114.861, 115.923, 108.811, 109.354, 107.802,
                                 104.790, 107.689, 104.405, 104.046, 100.000, 96.3342, 95.7880,
                                 88.6856, 90.0062, 89.5991, 87.6987, 83.2886, 83.6992, 80.0268,
                                 80.2146, 82.2778, 78.2842, 69.7213, 71.6091, 74.3490, 61.6040,
                                 69.8856, 75.0870, 63.5927, 46.4182, 66.8054, 63.3828};

double daylight_at(int nm) {
  const int i = std::min((nm - first_nm) / step_nm, static_cast<int>(daylight.size()) - 2);
  const double t = static_cast<double>(nm - first_nm) / step_nm - i;
  return lerp(daylight[i], daylight[i + 1], t);
}

// A Gaussian with a width for each side, given by their inverses.
double lobe(double nm, double center, double left, double right) {
  return std::exp(-0.5 * square((nm - center) * (nm < center ? left : right)));
}

// Colour matching functions of the CIE 1931 observer as sums of lobes.
Vec3<double> observer_at(double nm) {
  const double x = 1.056 * lobe(nm, 599.8, 0.0264, 0.0323) +
                   0.362 * lobe(nm, 442.0, 0.0624, 0.0374) -
                   0.065 * lobe(nm, 501.1, 0.0490, 0.0382);
  const double y =
      0.821 * lobe(nm, 568.8, 0.0213, 0.0247) + 0.286 * lobe(nm, 530.9, 0.0613, 0.0322);
  const double z =
      1.217 * lobe(nm, 437.0, 0.0845, 0.0278) + 0.681 * lobe(nm, 459.0, 0.0385, 0.0725);
  return {x, y, z};
}

// XYZ to linear Rec.709. @source IEC 61966-2-1
Vec3<double> to_rec709(const Vec3<double>& c) {
  return {3.2404542 * c.x - 1.5371385 * c.y - 0.4985314 * c.z,
          -0.9692660 * c.x + 1.8760108 * c.y + 0.0415560 * c.z,
          0.0556434 * c.x - 0.2040259 * c.y + 1.0572252 * c.z};
}

OpticalConstant constant_at(std::span<const OpticalConstant> samples, double nm) {
  const auto after = std::upper_bound(
      samples.begin(), samples.end(), nm,
      [](double value, const OpticalConstant& s) { return value < s.wavelength_nm; });
  if (after == samples.begin()) return samples.front();
  if (after == samples.end()) return samples.back();
  const OpticalConstant &a = *(after - 1), &b = *after;
  const double t = (nm - a.wavelength_nm) / (b.wavelength_nm - a.wavelength_nm);
  return {nm, lerp(a.n, b.n, t), lerp(a.k, b.k, t)};
}

void require_ascending(std::span<const OpticalConstant> samples) {
  if (samples.empty()) throw Error(Fault::Input, "optical constants: found none, expected some");
  for (size_t i = 1; i < samples.size(); ++i) {
    if (samples[i].wavelength_nm > samples[i - 1].wavelength_nm) continue;
    throw Error(Fault::Input,
                fmt::format("optical constants: found {} nm after {} nm, expected to ascend",
                            samples[i].wavelength_nm, samples[i - 1].wavelength_nm));
  }
}

}  // namespace

Vec3<double> optical_constants_to_rgb(std::span<const OpticalConstant> samples, double cosine) {
  require_ascending(samples);
  Vec3<double> reflected, white;
  for (int nm = first_nm; nm <= last_nm; ++nm) {
    const OpticalConstant at = constant_at(samples, nm);
    const Vec3<double> weight = observer_at(nm) * daylight_at(nm);
    reflected += weight * Conductor<double>{at.n, at.k}.eval(cosine);
    white += weight;
  }
  const Vec3<double> color = to_rec709(reflected), of_white = to_rec709(white);
  return {color.x / of_white.x, color.y / of_white.y, color.z / of_white.z};
}

}  // namespace kiln
