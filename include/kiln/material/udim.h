// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace kiln {

/// Tiles are numbered 1001 + u + 10 v, u from 0 to 9, v from 0 up.
///
/// A pattern is a file name in which one of these stands for the tile:
///
///     <UDIM>  <udim>  %(UDIM)d  $udim    1001, 1002, ..., 1011
///     <UVTILE>                           u1_v1, u2_v1, ..., u1_v2
///     <uvtile>                           u0_v0, u1_v0, ..., u0_v1
///     <U> and <V>, <u> and <v>           u and v, counted from 1 and from 0

/// Whether a tile's place stands in the text.
bool has_tile(std::string_view pattern);

/// The tile that makes the pattern this name; nothing where none does.
std::optional<int> tile_of(std::string_view pattern, std::string_view name);

/// The name of one tile.
std::string tile_name(std::string_view pattern, int tile);

/// The UDIM tile that a name ends in: "grid.1011.png" -> 1011.
std::optional<int> udim_tile(std::string_view file);

/// File names, tiles of one map made one pattern: "rock.1001.png", "rock.1002.png" ->
/// "rock.<UDIM>.png".
///
/// Numbers at the end of names count as tiles where there is a tile 1001 or more than one tile;
/// a number alone may be anything. `_u1_v1` likewise; where any counts from 0, all do.
/// @return sorted, each once
std::vector<std::string> with_tile_patterns(const std::vector<std::string>& files);

}  // namespace kiln
