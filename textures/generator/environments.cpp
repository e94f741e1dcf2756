// SPDX-License-Identifier: Apache-2.0
#include "environments.h"

#include <cmath>

#include "kiln/io/image_file.h"

namespace kiln::textures {

float shortened(double value) {
  if (value == 0) return 0;
  int exponent = 0;
  const double mantissa = std::frexp(value, &exponent);
  return static_cast<float>(std::ldexp(std::round(mantissa * 4096) / 4096, exponent));
}

void write_surroundings(const Surroundings& surroundings, const std::filesystem::path& folder) {
  write_image(folder / "env" / (surroundings.name + ".exr"), surroundings.paint(surroundings.size),
              {.type = PixelType::Float, .attributes = {}});
}

}  // namespace kiln::textures
