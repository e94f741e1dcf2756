// SPDX-License-Identifier: Apache-2.0
#include "fourier.h"

#include <bit>
#include <cmath>
#include <utility>

namespace kiln {
namespace {

struct Complex {
  WideDouble re, im;
};

Complex at(const Spectrum& x, size_t i) { return {x.re[i], x.im[i]}; }
void set(Spectrum& x, size_t i, const Complex& value) {
  x.re[i] = value.re;
  x.im[i] = value.im;
}
Complex operator+(const Complex& a, const Complex& b) { return {a.re + b.re, a.im + b.im}; }
Complex operator-(const Complex& a, const Complex& b) { return {a.re - b.re, a.im - b.im}; }
/// i times a
Complex turned(const Complex& a) { return {-a.im, a.re}; }
Complex times(const Complex& a, double re, double im) {
  const WideDouble r(re), i(im);
  return {fma(a.re, r, -(a.im * i)), fma(a.re, i, a.im * r)};
}

}  // namespace

Fourier::Fourier(int n) : n_(n) {
  const auto length = static_cast<size_t>(n);
  if (std::has_single_bit(length)) {
    for (size_t j = 0; j < std::max<size_t>(1, 3 * length / 4); ++j) {
      const double angle_rad = -2 * pi * static_cast<double>(j) / n;
      roots_.re.push_back(std::cos(angle_rad));
      roots_.im.push_back(std::sin(angle_rad));
    }
    return;
  }
  const size_t longer = std::bit_ceil(2 * length - 1);
  padded_.emplace_back(static_cast<int>(longer));
  Spectrum conjugate(static_cast<int>(longer)), scratch;
  for (size_t j = 0; j < length; ++j) {
    // j^2 modulo the period 2n keeps the angle small and its digits.
    const double angle_rad = -pi * static_cast<double>(j * j % (2 * length)) / n;
    chirp_.re.push_back(std::cos(angle_rad));
    chirp_.im.push_back(std::sin(angle_rad));
    for (const size_t mirror : {j, (longer - j) % longer}) {
      set(conjugate, mirror, {WideDouble(chirp_.re[j]), WideDouble(-chirp_.im[j])});
    }
  }
  padded_.front().forward(conjugate, scratch);
  for (size_t k = 0; k < longer; ++k) {
    chirp_transform_.re.push_back(conjugate.re[k].get(0) / static_cast<double>(longer));
    chirp_transform_.im.push_back(conjugate.im[k].get(0) / static_cast<double>(longer));
  }
}

void Fourier::forward(Spectrum& x, Spectrum& scratch) const {
  if (padded_.empty()) {
    forward_by_quartering(x, scratch);
  } else {
    forward_by_convolution(x, scratch);
  }
}

void Fourier::inverse(Spectrum& x, Spectrum& scratch) const {
  // Swapping the parts conjugates on both sides.
  std::swap(x.re, x.im);
  forward(x, scratch);
  std::swap(x.re, x.im);
}

// One step of a transform of 4 * quarter numbers, `stride` of which are interleaved.
void Fourier::quarter(const Spectrum& x, Spectrum& y, size_t quarter, size_t stride) const {
  const size_t apart = quarter * stride;
  for (size_t p = 0; p < quarter; ++p) {
    const size_t root = p * stride;
    for (size_t q = 0; q < stride; ++q) {
      const size_t from = root + q, to = 4 * root + q;
      const Complex a = at(x, from), b = at(x, from + apart);
      const Complex c = at(x, from + 2 * apart), d = at(x, from + 3 * apart);
      const Complex sum = a + c, difference = a - c, other = b + d, across = turned(b - d);
      set(y, to, sum + other);
      set(y, to + stride, times(difference - across, roots_.re[root], roots_.im[root]));
      set(y, to + 2 * stride, times(sum - other, roots_.re[2 * root], roots_.im[2 * root]));
      set(y, to + 3 * stride, times(difference + across, roots_.re[3 * root], roots_.im[3 * root]));
    }
  }
}

void Fourier::forward_by_quartering(Spectrum& x, Spectrum& scratch) const {
  if (scratch.re.size() != x.re.size()) scratch = Spectrum(n_);
  size_t length = static_cast<size_t>(n_), stride = 1;
  for (; length >= 4; length /= 4, stride *= 4) {
    quarter(x, scratch, length / 4, stride);
    std::swap(x, scratch);
  }
  if (length < 2) return;
  for (size_t q = 0; q < stride; ++q) {
    const Complex a = at(x, q), b = at(x, q + stride);
    set(x, q, a + b);
    set(x, q + stride, a - b);
  }
}

// With j k = (j^2 + k^2 - (k - j)^2) / 2 the transform is a convolution with a chirp.
void Fourier::forward_by_convolution(Spectrum& x, Spectrum& scratch) const {
  const Fourier& longer = padded_.front();
  Spectrum product(longer.length());
  for (size_t j = 0; j < chirp_.re.size(); ++j) {
    set(product, j, times(at(x, j), chirp_.re[j], chirp_.im[j]));
  }
  longer.forward(product, scratch);
  for (size_t k = 0; k < product.re.size(); ++k) {
    set(product, k, times(at(product, k), chirp_transform_.re[k], chirp_transform_.im[k]));
  }
  longer.inverse(product, scratch);
  for (size_t j = 0; j < chirp_.re.size(); ++j) {
    set(x, j, times(at(product, j), chirp_.re[j], chirp_.im[j]));
  }
}

}  // namespace kiln
