// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "kiln/table/lut.h"

namespace kiln {

enum class SnippetLanguage { Glsl, Hlsl, Cpp };

/// Code that looks up exactly this table, with five points to check it by.
/// @param file  name of the table's file, for the comment
/// @param rgbd  stored as RGBD: to be decoded before use
/// @error Fault::Usage where a sampler cannot hold the channels
std::string lookup_snippet(LutSource& lut, SnippetLanguage language, const std::string& file,
                           bool rgbd);

}  // namespace kiln
