// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "kiln/light/filter_error.h"
#include "kiln/light/prefilter.h"
#include "light_product.h"

namespace kiln {

/// A light made ready to be filtered with some lobes.
///
/// The samples of the source are point masses to a lobe that spans several of them. To one that is
/// narrower than they are apart, they would be points with nothing in between: it sees the picture
/// instead, which is interpolated.
class LightFilter {
 public:
  /// @param light  outlives this
  LightFilter(const Light& light, const std::vector<FilterLobe>& lobes);

  FilteredLevel filter(const FilterLobe& lobe, const SphereGrid& grid) const;

  /// As filter_errors, against what each level is filtered from.
  std::vector<FilterError> errors(const std::vector<FilteredLevel>& levels,
                                  double mean_radiance) const;

 private:
  bool sees_picture(const FilterLobe& lobe) const;

  const Light& light_;
  std::optional<Prefilter> masses_, picture_;  ///< for the lobes that see each
};

}  // namespace kiln
