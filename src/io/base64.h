// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace kiln::io {

/// The bytes of a text in base64, up to the first character that is none of it.
/// @source RFC 4648, section 4
std::string base64_bytes(std::string_view text);

}  // namespace kiln::io
