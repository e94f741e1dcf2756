// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace kiln {

/// Numbers out of a file of any kind, with what the file says of their arrangement.
struct NumberArray {
  /// How the file holds a number. `Integer` and `Decimal` are numbers written as text: integers may
  /// be anything, the bits of halves too.
  enum class Stored { Uint8, Uint16, Half, Float, Double, Rgb10a2, Integer, Decimal };

  std::string name;            ///< of the variable in a text file, else empty
  std::vector<int> shape;      ///< slowest first: {h, w, c}, {d, h, w, c}; {n} where nothing tells
  std::vector<double> values;  ///< of images normalised to [0,1]; of texts as written
  Stored stored = Stored::Float;
  std::vector<std::string> channels;                            ///< names, where known
  std::vector<std::pair<std::string, std::string>> attributes;  ///< metadata of the file
  std::vector<std::string> columns;  ///< coordinates that a long-form CSV named
  std::vector<std::string> notes;
};

}  // namespace kiln
