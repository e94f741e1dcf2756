// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace kiln {

/// The channels of a table at one point, to about 1e-11.
/// @valid mu in [1e-4, 1], roughness in [0, 1]
/// @error Fault::Usage for an unknown table or a point outside the domain
std::vector<double> integrate_at(const std::string& table, double mu, double roughness);

struct TableSummary {
  std::string name, summary;
  std::vector<std::string> channels;  ///< "scale: multiplies F0", ...
};
std::vector<TableSummary> list_tables();

/// What each channel of a table is.
std::vector<std::string> table_channels(const std::string& table);

}  // namespace kiln
