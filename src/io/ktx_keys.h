// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>

#include "kiln/io/image_file.h"

namespace kiln::io {

/// The keys and values of a KTX of either version: sorted by the keys, as version 2 demands, values
/// as text with a zero at the end.
/// @param own          the format's own
/// @param writer_key   for the attribute Software, and "kiln" where there is none; empty: Software
///                     is an attribute as all others
/// @error Fault::Usage for names that the format cannot hold
std::string ktx_keys(std::map<std::string, std::string> own, const Attributes& attributes,
                     const std::string& writer_key);

}  // namespace kiln::io
