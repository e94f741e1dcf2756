// SPDX-License-Identifier: Apache-2.0
#include "decoding.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace kiln::validate {
namespace {

using Kind = Decoding::Kind;
constexpr double half_step = 1.0 / 2048;

double srgb_to_linear(double v) {
  return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

// Integers in a text may be fractions of a largest one or the bits of halves.
std::vector<Decoding> integer_decodings(const std::vector<double>& values) {
  double greatest = 0, least = 0;
  for (const double value : values) {
    if (!std::isfinite(value)) return {};
    greatest = std::max(greatest, value);
    least = std::min(least, value);
  }
  if (least < 0 || greatest > 65535) return {};
  if (greatest <= 1) return {{Kind::AsStored, 1, 0, 0, "as stored"}};
  if (greatest <= 255) return {{Kind::Scaled, 1.0 / 255, 0, 1.0 / 255, "divided by 255"}};
  return {{Kind::HalfBits, 1, 0, half_step, "bits of halves"},
          {Kind::Scaled, 1.0 / 65535, 0, 1.0 / 65535, "divided by 65535"}};
}

double step_of(NumberArray::Stored stored) {
  switch (stored) {
    case NumberArray::Stored::Uint8:
      return 1.0 / 255;
    case NumberArray::Stored::Uint16:
      return 1.0 / 65535;
    case NumberArray::Stored::Half:
      return half_step;
    case NumberArray::Stored::Rgb10a2:
      return 1.0 / 1023;
    default:
      return 0;
  }
}

bool within_unit(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(),
                     [](double value) { return value >= 0 && value <= 1; });
}

double decode_number(const Decoding& decoding, double number) {
  switch (decoding.kind) {
    case Kind::Scaled:
      return number * decoding.scale;
    case Kind::HalfBits:
      return half_value(static_cast<unsigned>(number));
    case Kind::Srgb:
      return srgb_to_linear(number);
    default:
      return number;
  }
}

}  // namespace

double half_value(unsigned bits) {
  const int exponent = static_cast<int>(bits >> 10) & 31;
  const double fraction = (bits & 1023) / 1024.0;
  const double sign = (bits & 0x8000) != 0 ? -1 : 1;
  if (exponent == 31) {
    return fraction > 0 ? std::numeric_limits<double>::quiet_NaN()
                        : sign * std::numeric_limits<double>::infinity();
  }
  return sign *
         (exponent == 0 ? std::ldexp(fraction, -14) : std::ldexp(1 + fraction, exponent - 15));
}

std::vector<Decoding> decodings(const NumberArray& array) {
  using Stored = NumberArray::Stored;
  if (array.stored == Stored::Integer) return integer_decodings(array.values);
  const double step = step_of(array.stored);
  std::vector<Decoding> found{{Kind::AsStored, 1, 0, step, "as stored"}};
  if (array.stored == Stored::Decimal || !within_unit(array.values)) return found;
  found.push_back({Kind::Srgb, 1, 0, 2.3 * step, "sRGB-encoded"});
  if (array.stored == Stored::Uint8) {
    found.push_back({Kind::Rgbd, 1, 4, 0.018, "RGBD: (c / 255)^2.2 / alpha"});
  }
  return found;
}

int decode(const Decoding& decoding, std::span<double> entry) {
  const bool rgbd = decoding.kind == Kind::Rgbd;
  const double divisor = rgbd ? std::max(entry[3], 1.0 / 255) : 1;
  const int count = rgbd ? 3 : static_cast<int>(entry.size());
  for (double& value : entry.first(count)) {
    // Colour over a divisor in alpha, under the power 2.2: the encoding of Babylon.js.
    value = rgbd ? std::pow(value, 2.2) / divisor : decode_number(decoding, value);
    if (!std::isfinite(value)) value = 0;
  }
  return count;
}

}  // namespace kiln::validate
