// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "axes.h"
#include "integrals.h"
#include "sheet.h"

namespace kiln::validate {

/// A part of a table read under some axes: [channel][alpha][mu], and where its entries lie.
struct Reading {
  Values values;
  std::vector<double> mus, alphas;
  double ceiling = 1e300;  ///< greatest value that the storage holds
};

/// The entries of the sheet at these places along the axes of directions and widths.
struct Places {
  std::vector<int> cosines, widths;
};
Places spread_places(const Sheet& sheet, bool transposed, int most);
Values values_of(const Sheet& sheet, bool transposed, const Places& places);

/// The entries at these places, not yet placed along axes.
Reading reading_of(const Sheet& sheet, bool transposed, const Places& places);
std::vector<double> cosines_of(const Sheet& sheet, const TableAxes& axes, const Places& places);
std::vector<double> alphas_of(const Sheet& sheet, const TableAxes& axes, const Places& places);

/// What a channel holds, and how far it is from that.
struct ChannelFit {
  int model = -1;  ///< on tried_lobes(); -1 for diffuse quantities and constants
  Meaning meaning = Meaning::Scale;
  bool constant = false;
  double level = 0;  ///< of a constant
  double rms = 1e9;
};

/// Channels that hold one value everywhere; the others are left as unknown.
std::vector<ChannelFit> constant_channels(const Values& values);

/// Replaces fits by better ones among these quantities of a lobe (model -1: diffuse).
void improve_fits(const Reading& reading, int model, const Grid& grid,
                  std::span<const Meaning> quantities, std::vector<ChannelFit>& fits);

/// The exact entries that a fit stands for, [alpha][mu]. Where alpha or n.v is 0 they are the
/// mirror's or those a little off grazing, if the stored ones are nearer to these.
std::vector<double> exact_entries(const ChannelFit& fit, const Reading& reading, int channel,
                                  const Grid& grid);

/// Mean of the rms errors of channels that vary, none counted beyond a tenth.
double score_of(const std::vector<ChannelFit>& fits);

}  // namespace kiln::validate
