// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "channel_lists.h"
#include "kiln/brdf/roughness.h"
#include "kiln/parallel/rows.h"

namespace kiln {
namespace {

using enum Quantity;

// Fourier terms of E over the azimuth, which is even and has the period pi: 8 equal steps of a half
// circle are 5 different ones, and tell the mean and two harmonics apart.
constexpr int steps = 8;
constexpr int harmonics[] = {0, 2, 4};

struct Widths {
  double x, y;
};

// Burley's: the widths keep their product while the aspect grows.
Widths widths_of(double roughness, double anisotropy) {
  const double aspect = std::sqrt(1 - 0.9 * std::clamp(anisotropy, 0.0, 1.0));
  const double alpha = to_alpha(roughness);
  return {std::clamp(alpha / aspect, min_alpha, 1.0), std::clamp(alpha * aspect, min_alpha, 1.0)};
}

std::array<double, 3> fourier_terms(const LobeIntegrals& lobe, double mu, const Widths& widths) {
  std::array<double, 3> terms{};
  for (int k = 0; k <= steps / 2; ++k) {
    const double azimuth = pi * k / steps;
    const double times = k == 0 || k == steps / 2 ? 1 : 2;
    const double total = lobe.at({mu, widths.x, widths.y, azimuth}).total();
    for (int h = 0; h < 3; ++h) {
      const double weight = (h == 0 ? 1.0 : 2.0) * std::cos(harmonics[h] * azimuth);
      terms[h] += times * weight * total / steps;
    }
  }
  return terms;
}

// [harmonic][anisotropy][roughness][mu]
std::vector<std::vector<double>> make_terms(TableContext& context) {
  const auto& mus = context.grid.of(Mu);
  const auto& roughnesses = context.grid.of(Roughness);
  const auto& anisotropies = context.grid.of(Anisotropy);
  const LobeIntegrals& lobe = context.lobes.of(context.models.lobe, {});
  const size_t rows = roughnesses.size() * anisotropies.size();
  std::vector<std::vector<double>> planes(3, std::vector<double>(rows * mus.size()));
  for_rows(static_cast<int>(rows), [&](int row) {
    const Widths widths =
        widths_of(roughnesses[row % roughnesses.size()], anisotropies[row / roughnesses.size()]);
    for (size_t i = 0; i < mus.size(); ++i) {
      const auto terms = fourier_terms(lobe, mus[i], widths);
      for (int h = 0; h < 3; ++h) planes[h][row * mus.size() + i] = terms[h];
    }
  });
  return planes;
}

template <int Plane>
std::vector<double> fill(TableContext& context) {
  return shared_planes(context, "anisotropic", make_terms)[Plane];
}

}  // namespace

void add_anisotropic_channels(std::vector<ChannelFacts>& list) {
  const std::vector<Quantity> solid = {Mu, Roughness, Anisotropy};
  list.push_back({"azimuth-mean", {}, "E: its mean over the azimuth", solid, fill<0>});
  list.push_back({"azimuth-cos2", {}, "E: amplitude of cos(2 azimuth)", solid, fill<1>});
  list.push_back({"azimuth-cos4", {}, "E: amplitude of cos(4 azimuth)", solid, fill<2>});
}

}  // namespace kiln
