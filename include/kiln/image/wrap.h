// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>

namespace kiln {

/// What lies beyond the edge of a texture, for whatever looks at neighbours.
enum class Wrap { Repeat, Clamp, Mirror };
inline constexpr std::array<std::string_view, 3> wrap_names = {"repeat", "clamp", "mirror"};

/// The texel that stands at `at` on an axis of `count` texels. Mirrored images repeat their edge.
/// @valid count > 0
constexpr int wrapped(Wrap wrap, int at, int count) {
  if (at >= 0 && at < count) return at;
  if (wrap == Wrap::Clamp) return at < 0 ? 0 : count - 1;
  const int period = wrap == Wrap::Mirror ? 2 * count : count;
  const int within = (at % period + period) % period;
  return within < count ? within : period - 1 - within;
}

}  // namespace kiln
