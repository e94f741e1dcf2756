// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "kiln/image/number_array.h"
#include "kiln/io/image_file.h"

namespace kiln {

/// All arrays of numbers in a file of any kind; the contents decide the kind, then the extension.
///
/// | kind                           | what is returned                                            |
/// |--------------------------------|-------------------------------------------------------------|
/// | images (read_image)            | one array {h, w, c}; volumes {d, h, w, c}                   |
/// | .npy                           | one array of the shape it states; u1 and u2 scaled to [0,1] |
/// | CSV, numbers in lines          | one array {h, w}; with one number a line {n}; of coordinate |
/// |                                | columns that fill a grid, {.., n2, n1, c}, the first column |
/// |                                | the fastest, coordinates in the file's order or ascending   |
/// | C, C++, JavaScript, JSON,      | every array of at least 16 numbers by its name, in the shape|
/// | Python                         | that braces or a declaration give, else {n}                 |
/// | PNG as base64 in such a text   | an image, by the name of its variable                       |
///
/// Comments "# key: value" in CSV, and "key: value" in the first comment of a C header, are
/// attributes. Numbers are read without regard to the locale.
/// @error Fault::Input, message "PATH: what was found, what was expected"
std::vector<NumberArray> read_arrays(const std::filesystem::path& path,
                                     const ReadLimits& limits = {});

}  // namespace kiln
