// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "kiln/image/layers.h"
#include "kiln/image/number_array.h"

namespace kiln {

/// What the axis of directions holds, for u in [0,1] along it.
enum class CosineAxis {
  Cosine,        ///< mu = u
  SquareRoot,    ///< mu = u^2
  CubeRoot,      ///< mu = u^3
  OneMinusRoot,  ///< mu = 1 - (1-u)^2; reversed: u = sqrt(1 - mu)
};

/// What the axis of widths holds, for u in [0,1] along it. Only alpha can be told from the entries:
/// `roughness` with alpha = roughness^2 and sqrt(alpha) are one axis, and so are alpha and a
/// roughness that was taken for alpha.
enum class WidthAxis {
  Roughness,   ///< alpha = u^2
  Alpha,       ///< alpha = u
  FourthRoot,  ///< alpha = u^4: squared once too often
};

/// Where entry i of n lies along its axis: u = clamp((i + offset) / (nodes ? n - 1 : n), 0, 1).
struct Placement {
  double offset = 0.5;
  bool nodes = false;
  bool operator==(const Placement&) const = default;
};

/// The axes of a table.
struct TableAxes {
  bool transposed = false;  ///< x is the width, y the direction
  CosineAxis cosine = CosineAxis::Cosine;
  WidthAxis width = WidthAxis::Roughness;
  bool cosine_reversed = false, width_reversed = false;  ///< entry i counts from the other end
  Placement cosine_alignment{}, width_alignment{};
  bool operator==(const TableAxes&) const = default;
};

/// What one channel holds and how wrong it is.
struct ChannelMatch {
  std::string channel;   ///< its name in the file, else its number
  std::string quantity;  ///< "scale", "bias", "albedo", "1 - albedo", ...; "unknown"; "constant 0"
  std::string distribution, masking;  ///< of the lobe; empty where none is meant
  double max_error = 0, rms_error = 0;
  bool known = false;     ///< the quantity explains the entries
  bool constant = false;  ///< holds one value everywhere
};

/// A convention under which numbers were read, and how well exact integrals agree with them.
struct Match {
  std::string array;        ///< name of the variable, where the file has several
  std::string arrangement;  ///< how numbers became entries: "[16 16 2], interleaved"
  std::string decoding;     ///< how numbers became values: "as stored", "bits of halves", ...
  std::string table_class;  ///< "split-sum", "directional-albedo", "average-albedo", ...
  std::string convention;   ///< all of it in one readable line
  TableAxes axes;
  std::vector<ChannelMatch> channels;
  double max_error = 0, rms_error = 0;  ///< over the channels that are known
  double mu = 0, roughness = 0;         ///< where the greatest error sits; roughness = sqrt(alpha)
  int x = 0, y = 0, z = 0;              ///< z: slice
  std::string channel;
};

/// What a table is and how wrong it is.
struct Verdict {
  bool fits = false;   ///< `best` is what the table holds; else no convention fits, best is nearest
  bool within = true;  ///< max_error was not asked for, or is kept by a table that fits
  Match best;
  std::optional<Match> runner_up;  ///< best of another class: other axes, lobe or meaning
  double ratio = 0;           ///< rms error of the runner-up over that of the best, same channels
  std::vector<Match> others;  ///< what other arrays of the file are
  std::vector<std::string> statements;  ///< what is wrong or cannot be told, smallest first
  std::vector<std::string> presets;     ///< whose convention coincides
  Layers errors;                        ///< stored - exact, one plane "error.NAME" a known channel
};

struct VerifyOptions {
  double max_error = 0;  ///< 0 reports only
};

/// Finds the convention under which numbers are a table of a listed lobe, by trying them all: axes,
/// reversals, alignments, shifts, encodings, meanings of channels, lobes; a few entries first, then
/// those that are left on all of them. Never guesses: what no convention explains has fits = false.
///
/// @valid arrays of 64 numbers or more (curves: 8); others fit nothing
Verdict verify_tables(const std::vector<NumberArray>& arrays, const VerifyOptions& options = {});

}  // namespace kiln
