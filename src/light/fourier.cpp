// SPDX-License-Identifier: Apache-2.0
#include "fourier.h"

#include <bit>
#include <cmath>
#include <utility>

namespace kiln {
namespace {

constexpr double pi = 3.14159265358979323846;

bool is_power_of_two(int n) { return std::has_single_bit(static_cast<unsigned>(n)); }

void set_unit(Spectrum& to, size_t at, double angle_rad) {
  to.re[at] = std::cos(angle_rad);
  to.im[at] = std::sin(angle_rad);
}

void multiply(Spectrum& a, const Spectrum& b, size_t count) {
  for (size_t j = 0; j < count; ++j) {
    const double re = a.re[j] * b.re[j] - a.im[j] * b.im[j];
    a.im[j] = a.re[j] * b.im[j] + a.im[j] * b.re[j];
    a.re[j] = re;
  }
}

}  // namespace

Fourier::Fourier(int n) : n_(n) {
  if (is_power_of_two(n)) {
    roots_ = Spectrum(n / 2);
    for (size_t j = 0; j < roots_.re.size(); ++j) {
      set_unit(roots_, j, -2 * pi * static_cast<double>(j) / n);
    }
    return;
  }
  const int longer = static_cast<int>(std::bit_ceil(static_cast<unsigned>(2 * n - 1)));
  padded_.emplace_back(longer);
  chirp_ = Spectrum(n);
  chirp_transform_ = Spectrum(longer);
  for (int j = 0; j < n; ++j) {
    // j^2 modulo the period 2n keeps the angle small and its digits.
    const long long period = 2LL * n, square = static_cast<long long>(j) * j % period;
    set_unit(chirp_, static_cast<size_t>(j), -pi * static_cast<double>(square) / n);
    for (int at : {j, (longer - j) % longer}) {
      chirp_transform_.re[static_cast<size_t>(at)] = chirp_.re[static_cast<size_t>(j)];
      chirp_transform_.im[static_cast<size_t>(at)] = -chirp_.im[static_cast<size_t>(j)];
    }
  }
  padded_.front().forward(chirp_transform_);
}

void Fourier::forward(Spectrum& x) const {
  if (padded_.empty()) {
    forward_by_halving(x);
  } else {
    forward_by_convolution(x);
  }
}

void Fourier::inverse(Spectrum& x) const {
  // Swapping the parts conjugates on both sides.
  std::swap(x.re, x.im);
  forward(x);
  std::swap(x.re, x.im);
}

void Fourier::forward_by_halving(Spectrum& x) const {
  const auto n = static_cast<size_t>(n_);
  Spectrum y(n_);
  for (size_t half = n / 2, stride = 1; half >= 1; half /= 2, stride *= 2) {
    for (size_t p = 0; p < half; ++p) {
      const double c = roots_.re[p * stride], s = roots_.im[p * stride];
      const size_t a = stride * p, b = a + stride * half, to = 2 * a;
      for (size_t q = 0; q < stride; ++q) {
        const double re = x.re[a + q] - x.re[b + q], im = x.im[a + q] - x.im[b + q];
        y.re[to + q] = x.re[a + q] + x.re[b + q];
        y.im[to + q] = x.im[a + q] + x.im[b + q];
        y.re[to + stride + q] = re * c - im * s;
        y.im[to + stride + q] = re * s + im * c;
      }
    }
    std::swap(x, y);
  }
}

// With j k = (j^2 + k^2 - (k - j)^2) / 2 the transform is a convolution with a chirp.
void Fourier::forward_by_convolution(Spectrum& x) const {
  const auto n = static_cast<size_t>(n_);
  const Fourier& longer = padded_.front();
  Spectrum product(longer.length());
  for (size_t j = 0; j < n; ++j) {
    product.re[j] = x.re[j] * chirp_.re[j] - x.im[j] * chirp_.im[j];
    product.im[j] = x.re[j] * chirp_.im[j] + x.im[j] * chirp_.re[j];
  }
  longer.forward(product);
  multiply(product, chirp_transform_, product.re.size());
  longer.inverse(product);
  multiply(product, chirp_, n);
  for (size_t j = 0; j < n; ++j) {
    x.re[j] = product.re[j] / longer.length();
    x.im[j] = product.im[j] / longer.length();
  }
}

}  // namespace kiln
