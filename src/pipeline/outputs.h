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

/// Whether files of that name are made for viewing: radiance goes through the display.
bool is_for_viewing(const std::filesystem::path& path);

/// What the file of a picture holds.
enum class Shown {
  Radiance,
  View  ///< Artifact::view, or a LateView
};
/// @param has_view  the picture is one that no display shows as it is
/// @error Fault::Usage where the format can hold neither
Shown shown_by(const Task& task, bool has_view);

/// A picture, or a band of it, as the format of the task's file holds it: viewing formats through
/// the display, errors only where channels have names.
Layers stored_picture(const Plan& plan, const Task& task, Layers picture, Shown shown,
                      const ColorConfig& config);

/// How the file of a task of one is written.
WriteOptions write_options(const Plan& plan, const Task& task, const Artifact& artifact);

struct Written {
  std::vector<std::string> outputs;  ///< below the output folder, with '/'
  std::vector<std::string> notes;
};

/// The name of a map's file below the output folder: the pattern `out` with "{suffix}" replaced, a
/// file in the folder `out`, or `out` itself.
/// @param extension  where `out` has none
/// @param is_file    `out` names a file by its extension
/// @param files      that the bake makes
/// @error Fault::Usage when `out` names one file and the bake makes several
std::string map_file_name(const Task& task, const std::string& map, const std::string& extension,
                          bool is_file, size_t files);

/// The type that the task asks for, else the preferred one where it is held, else the first held.
PixelType held_type(const Task& task, const std::string& preferred,
                    const std::vector<PixelType>& held);

/// What is to be told of clamped values of a file; nothing where there are none.
std::string clamping_note(const std::filesystem::path& path, PixelType type,
                          const WriteFacts& facts);

/// Writes what a task baked, each file whole or not at all.
/// @param working  name of the working space
Written write_outputs(const Plan& plan, const Task& task, const Baked& baked,
                      const ColorConfig& config);

/// What a reader gets of an image stored as a pixel type of textures, or as "rgbe".
Layers coded_as(const Layers& image, const std::string& pixel_type);

}  // namespace kiln
