// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "kiln/math/wide.h"

namespace kiln {

/// Sequences of complex numbers, one to a lane, real and imaginary parts apart.
struct Spectrum {
  std::vector<WideDouble> re, im;

  explicit Spectrum(int n = 0)
      : re(static_cast<std::size_t>(n), WideDouble(0.0)),
        im(static_cast<std::size_t>(n), WideDouble(0.0)) {}
};

/// The discrete Fourier transform of n complex numbers, lane for lane,
///
///     X[k] = sum x[j] exp(-2 pi i j k / n),
///
/// by quartering where n is a power of two, else as a convolution of such a length.
/// @accuracy 1e-15 times log2(n), relative to the norm
/// @source   Stockham's self-sorting form; Bluestein 1970
class Fourier {
 public:
  explicit Fourier(int n);

  int length() const { return n_; }

  /// Replaces x by its transform; `scratch` is overwritten, and may be used again and again.
  void forward(Spectrum& x, Spectrum& scratch) const;

  /// Replaces x by the unscaled inverse: exp(+2 pi i j k / n), no division by n.
  void inverse(Spectrum& x, Spectrum& scratch) const;

 private:
  struct Roots {
    std::vector<double> re, im;
  };

  void forward_by_quartering(Spectrum& x, Spectrum& scratch) const;
  void forward_by_convolution(Spectrum& x, Spectrum& scratch) const;
  void quarter(const Spectrum& x, Spectrum& y, std::size_t quarter, std::size_t stride) const;

  int n_;
  Roots roots_;  ///< exp(-2 pi i j / n), the first three quarters
  // Only where n is not a power of two:
  std::vector<Fourier> padded_;  ///< the transform of the convolution
  Roots chirp_;                  ///< exp(-pi i j^2 / n)
  Roots chirp_transform_;        ///< of the conjugate chirp, wrapped around
};

}  // namespace kiln
