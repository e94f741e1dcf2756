// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "kiln/image/number_array.h"

namespace kiln::io {

/// A number at the front of a text, as programs and tables write it: decimal, 0x with digits or
/// with a binary exponent, a suffix of C (f, u, l) or of JavaScript (n).
struct NumberText {
  double value = 0;
  bool integer = false;  ///< no point, exponent or f
  size_t length = 0;     ///< [char], 0 where no number stands; a word's beginning is none
};
NumberText number_at_front(std::string_view text);

/// The number that fills all of `text`; also nan and inf in any spelling of case.
std::optional<NumberText> whole_number(std::string_view text);

/// Numbers in lines, with or without a header line; nothing where the text is no such table.
/// @error Fault::Input, without the path, naming the line that differs from those before
std::optional<NumberArray> read_number_table(std::string_view text);

/// Text of a program: its arrays, and images it holds as base64.
struct ScriptArrays {
  std::vector<NumberArray> arrays;
  struct Encoded {
    std::string name;  ///< of the variable
    std::string png;   ///< bytes
  };
  std::vector<Encoded> images;
};

/// Every array of at least `least` numbers between brackets or braces.
ScriptArrays read_script_arrays(std::string_view text, size_t least);

}  // namespace kiln::io
