// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "kiln/image/layers.h"

namespace kiln::textures {

/// A lat-long environment: +Y up, image centre +Z, left quarter +X, right quarter -X.
struct Surroundings {
  std::string name;
  Size size;
  std::function<Layers(Size)> paint;
};

/// A dark grey studio: a large warm key light on the side of +X, a tall cool strip on that of -X, a
/// light overhead and a dim card behind the camera. A white matte plane facing +Z shows about 1.
Surroundings studio();

/// A clear sky over dry ground, with a sun of true strength: a disc of 0.53 degree whose radiance
/// is 2e5 times that of the zenith.
Surroundings sky();

inline constexpr double sun_diameter_rad = 0.53 * 3.14159265358979323846 / 180;
inline constexpr double sun_over_zenith = 2e5;

/// Writes `folder / "env" / name.exr`, float.
void write_surroundings(const Surroundings& surroundings, const std::filesystem::path& folder);

/// `value` with 12 bits of mantissa: far below what is seen, and it compresses.
float shortened(double value);

}  // namespace kiln::textures
