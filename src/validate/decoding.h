// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "kiln/image/number_array.h"

namespace kiln::validate {

/// A way to read stored numbers as values.
struct Decoding {
  enum class Kind { AsStored, Scaled, HalfBits, Srgb, Rgbd };
  Kind kind = Kind::AsStored;
  double scale = 1;   ///< of Scaled
  int channels = 0;   ///< that it wants; 0 takes any
  double step = 0;    ///< greatest distance between values that neighbouring numbers stand for
  std::string words;  ///< "as stored", "divided by 255", ...
};

/// The ways worth trying for numbers stored like these.
std::vector<Decoding> decodings(const NumberArray& array);

/// The channels of one entry, numbers to values; what is not finite becomes 0.
/// @return how many channels hold values now
int decode(const Decoding& decoding, std::span<double> entry);

/// The value of sixteen bits as an IEEE half.
double half_value(unsigned bits);

}  // namespace kiln::validate
