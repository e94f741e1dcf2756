// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "kiln/bake/bake.h"

namespace kiln {

// What bakes that make maps out of maps have in common.

/// Formats of maps, by name: "exr", "png", ...
const std::vector<std::string>& map_formats();

/// ".png" where every map is stored in integers, else ".exr"; or the one asked for.
std::string map_extension(const std::string& format, const MapBands& maps);

/// The narrowest type that holds what these maps store: "uint8" up to "float".
std::string widest_type(const std::vector<const GivenMap*>& maps);

/// Of files with so many: "Y", or as many of R, G, B and A.
std::vector<std::string> channel_names(size_t count);

/// Every slot there is, for MapNeeds.
std::vector<Slot> every_slot();

/// A file of a sheet with channels of these names, without texels.
Artifact map_file(const std::string& name, const std::string& extension,
                  const std::vector<std::string>& channels);

/// The same, of colours in the working space, which the file holds encoded if its numbers are
/// integers.
Artifact color_file(const std::string& name, const std::string& extension, const MapBands& maps);

/// Rows of an image with these planes.
Layers layers_of(std::vector<Plane> planes, const std::vector<std::string>& names);

}  // namespace kiln
