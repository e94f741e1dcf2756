// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace kiln {

/// A quantity that a table runs over.
enum class Quantity {
  Mu,          ///< n.v [0..1]
  Roughness,   ///< perceptual [0..1]; alpha is its square
  F0,          ///< reflectance at normal incidence [0..1]
  Ior,         ///< relative index of refraction, >= 1
  Anisotropy,  ///< [0..1]
  Cosine,      ///< n.l [-1..1]
  Curvature,   ///< [1/mm] [0..1]
  Exponent     ///< of Schlick's form
};
inline constexpr int quantity_count = 8;

/// How a quantity lies along an axis of a table, whose position u runs over [0,1].
struct AxisMapping {
  std::string name;                  ///< "sqrt-mu"
  std::vector<std::string> aliases;  ///< other spellings
  Quantity quantity = Quantity::Mu;
  std::string meaning;        ///< "u = sqrt(n.v)"
  std::string position_code;  ///< u as an expression that GLSL, HLSL and C++ share
  double (*value)(double u) = nullptr;
  double (*position)(double value) = nullptr;
};

const std::vector<AxisMapping>& all_axis_mappings();

/// @error Fault::Usage, naming the nearest known mapping
const AxisMapping& find_axis_mapping(const std::string& name);

enum class Alignment {
  Center,  ///< u = (i + 1/2) / N
  Corner   ///< u = i / (N - 1): first and last entries lie on the borders
};
double entry_position(int i, int count, Alignment alignment);

/// The name a variable of this quantity has in lookup code and messages: "mu", "roughness".
std::string quantity_name(Quantity quantity);

}  // namespace kiln
