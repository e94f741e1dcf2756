// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "kiln/table/lut.h"

namespace kiln::test {

/// A table of the list with its defaults, of that size.
inline TableRecipe recipe_for(const std::string& table, Size size, int depth = 3) {
  TableRecipe recipe = recipe_of(find_table(table));
  recipe.size = size;
  recipe.depth = depth;
  complete(recipe);
  return recipe;
}

}  // namespace kiln::test
