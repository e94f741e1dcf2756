// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace kiln {

/// Sizes and roughnesses of a mip chain.
struct ChainPlan {
  std::vector<int> sizes;         ///< edge of a face [texel]
  std::vector<double> roughness;  ///< perceptual, one per level; 0: the environment itself
};

/// How roughness runs along the levels of an engine's chain.
struct RoughnessCurve {
  std::string name;
  std::string meaning;  ///< with t = level / (levels - 1)
  std::string source;
  /// Levels of a chain whose first has that edge.
  int (*levels)(int size);
  /// Perceptual roughness of a level.
  double (*roughness)(int level, int levels, int size);
};

/// filament, linear, unity, babylon, materialx, playcanvas
const std::vector<RoughnessCurve>& all_roughness_curves();

/// @param curve  name of a curve, or roughnesses separated by commas, one per level
/// @error Fault::Usage for an unknown name, a roughness outside [0,1], or more levels than a chain
///        of that size has
ChainPlan plan_chain(const std::string& curve, int size);

}  // namespace kiln
