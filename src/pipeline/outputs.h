// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kiln/color/color.h"
#include "kiln/pipeline/plan.h"

namespace kiln {

/// Checks that a task's output can be: inside the output folder, of a known format, of a type that
/// the format holds.
/// @error Fault::Usage
void check_output(const Task& task);

/// Whether the extension is that of an image.
bool names_an_image(const std::filesystem::path& path);

/// Whether one name is the other, or a folder that holds it.
bool collide(const std::string& a, const std::string& b);

struct Written {
  std::vector<std::string> outputs;  ///< below the output folder, with '/'
  std::vector<std::string> notes;
};

/// Writes what a task baked, each file whole or not at all.
/// @param working  name of the working space
Written write_outputs(const Plan& plan, const Task& task, const Baked& baked,
                      const ColorConfig& config);

/// What a reader gets of an image stored as a pixel type of textures, or as "rgbe".
Layers coded_as(const Layers& image, const std::string& pixel_type);

}  // namespace kiln
