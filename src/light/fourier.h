// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

namespace kiln {

/// Complex numbers, real and imaginary parts apart.
struct Spectrum {
  std::vector<double> re, im;

  explicit Spectrum(int n = 0) : re(static_cast<std::size_t>(n)), im(static_cast<std::size_t>(n)) {}
};

/// The discrete Fourier transform of n complex numbers,
///
///     X[k] = sum x[j] exp(-2 pi i j k / n),
///
/// by halving where n is a power of two, else as a convolution of such a length.
/// @accuracy 1e-15 times log2(n), relative to the norm
/// @source   Stockham's self-sorting form; Bluestein 1970
class Fourier {
 public:
  explicit Fourier(int n);

  int length() const { return n_; }

  /// Replaces x by its transform.
  void forward(Spectrum& x) const;

  /// Replaces x by the unscaled inverse: exp(+2 pi i j k / n), no division by n.
  void inverse(Spectrum& x) const;

 private:
  void forward_by_halving(Spectrum& x) const;
  void forward_by_convolution(Spectrum& x) const;

  int n_;
  Spectrum roots_;  ///< exp(-2 pi i j / n), first half
  // Only where n is not a power of two:
  std::vector<Fourier> padded_;  ///< the transform of the convolution
  Spectrum chirp_;               ///< exp(-pi i j^2 / n)
  Spectrum chirp_transform_;     ///< of the conjugate chirp, wrapped around
};

}  // namespace kiln
