// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "kiln/brdf/eon.h"
#include "kiln/brdf/ggx.h"
#include "kiln/brdf/lambert.h"
#include "kiln/brdf/schlick.h"
#include "kiln/brdf/smith.h"

namespace kiln {

/// A closed list of models, each a template on the number type. Parsing, help, docs and the
/// contract tests follow from the lists below: a new model is one file and one line here.
template <template <class> class... Models>
struct ModelList {
  /// Calls visit.operator()<Model>() for each model in order.
  template <class Visit>
  static void for_each(Visit&& visit) {
    (visit.template operator()<Models>(), ...);
  }
};

using Distributions = ModelList<Ggx>;
using Maskings = ModelList<SmithCorrelated>;
using Fresnels = ModelList<Schlick>;
using Diffuses = ModelList<Lambert, Eon>;

struct ModelFacts {
  std::string family;  ///< "distribution", "masking", "fresnel", "diffuse"
  std::string name;
  std::string summary;
  std::string source;
};

/// Every model of every list.
const std::vector<ModelFacts>& all_models();

/// Names of one family, in the order of its list.
std::vector<std::string> model_names(std::string_view family);

}  // namespace kiln
