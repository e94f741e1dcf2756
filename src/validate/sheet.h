// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "decoding.h"
#include "kiln/core/size.h"
#include "kiln/image/number_array.h"

namespace kiln::validate {

/// Where the channels of entries are found among the numbers of an array.
struct Arrangement {
  Size size;
  int channels = 1;
  bool planar = false;
  std::string words;
  int depth = 1;  ///< slices, one below the other in `size`

  size_t at(int channel, size_t entry) const {
    return planar ? channel * static_cast<size_t>(area(size)) + entry : entry * channels + channel;
  }
};

/// Numbers arranged and decoded in one of the ways that they may be meant. One row is a curve.
struct Sheet {
  std::shared_ptr<const NumberArray> array;
  Arrangement arrangement;
  Decoding decoding;
  std::vector<std::string> channels;  ///< names of those that are left when decoded

  Size size() const { return arrangement.size; }
  bool is_curve() const { return arrangement.size.height == 1; }
};

/// All ways worth trying to read each array by itself.
std::vector<Sheet> possible_sheets(const std::vector<NumberArray>& arrays);

/// The same for two to four arrays of one shape that are a channel each; else nothing.
std::vector<Sheet> joined_sheets(const std::vector<NumberArray>& arrays);

/// All ways worth trying to read each array as slices: told by its shape, a tall image, or a list
/// of as many numbers as a cube has.
std::vector<Sheet> solid_sheets(const std::vector<NumberArray>& arrays);

/// Values of the entries in these columns and rows: [channel][row][column].
using Values = std::vector<std::vector<double>>;
Values values_at(const Sheet& sheet, const std::vector<int>& columns, const std::vector<int>& rows);

/// 0, 1, ... n - 1, or about `most` of them, ends included, symmetric about the middle.
std::vector<int> spread_indices(int n, int most);

double variance(const std::vector<double>& values);

}  // namespace kiln::validate
