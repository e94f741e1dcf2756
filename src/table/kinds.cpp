// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "kiln/core/error.h"
#include "kiln/core/find_named.h"
#include "kiln/table/lut.h"

namespace kiln {
namespace {

// THE list of tables.
std::vector<TableFacts> make_list() {
  const Lobe ggx, cloth{"charlie", "neubelt", 0};
  return {
      {"split-sum",
       "F0 * scale + F90 * bias is the reflectance of the specular lobe",
       {"mu", "roughness"},
       {"scale", "bias"},
       ggx,
       "Karis 2013; Lazarov 2013"},
      {"directional-albedo",
       "share of light that the specular lobe reflects toward a direction, with F = 1 or --fresnel",
       {"mu", "roughness"},
       {"total"},
       ggx,
       "Kulla and Conty 2017"},
      {"average-albedo",
       "directional albedo averaged over directions",
       {"roughness"},
       {"average"},
       ggx,
       "Kulla and Conty 2017"},
      {"sheen",
       "directional albedo of a cloth lobe",
       {"mu", "roughness"},
       {"sheen"},
       cloth,
       "Estevez and Kulla 2017; Neubelt and Pettineo 2013"},
      {"f82",
       "split sum with the third term of Hoffman's edge tint",
       {"mu", "roughness"},
       {"scale", "bias", "f82"},
       ggx,
       "Hoffman 2019; Kutz et al. 2021"},
      {"ior",
       "reflectance of a dielectric by its index, over n.v, roughness and F0",
       {"mu", "roughness", "fourth-root-f0"},
       {"dielectric"},
       ggx,
       "Walter et al. 2007",
       {64, 64}},
      {"ior-share",
       "share of F90 in a dielectric's reflectance, by which Cycles interpolates",
       {"mu", "roughness", "fourth-root-f0"},
       {"dielectric-share"},
       ggx,
       "Walter et al. 2007",
       {16, 16}},
      {"schlick-share",
       "share of F90 in Schlick's reflectance with any exponent, by which Cycles interpolates",
       {"mu", "roughness", "schlick-exponent"},
       {"schlick-share"},
       ggx,
       "Schlick 1994",
       {16, 16}},
      {"anisotropic",
       "directional albedo of an anisotropic lobe as Fourier terms of the azimuth",
       {"mu", "roughness", "anisotropy"},
       {"azimuth-mean", "azimuth-cos2", "azimuth-cos4"},
       ggx,
       "Burley 2012 (aspect = sqrt(1 - 0.9 anisotropy)); Heitz 2014",
       {32, 32},
       8},
      {"diffuse",
       "directional albedo of diffuse models",
       {"mu", "roughness"},
       {"diffuse-burley", "diffuse-eon"},
       ggx,
       "Burley 2012; Portsmouth, Kutz and Hill 2025"},
      {"glass",
       "energy that a rough dielectric reflects and lets through, from both sides",
       {"mu", "roughness", "ior"},
       {"enter-reflected", "enter-transmitted", "leave-reflected", "leave-transmitted"},
       ggx,
       "Walter et al. 2007",
       {16, 16}},
      {"ltc",
       "linearly transformed cosines: the inverse matrix that fits the lobe",
       {"roughness", "sqrt-one-minus-mu"},
       {"ltc-m11", "ltc-m31", "ltc-m13", "ltc-m33"},
       ggx,
       "Heitz, Dupuy, Hill and Neubelt 2016",
       {64, 64}},
      {"skin",
       "irradiance of curved skin, scattering below the surface",
       {"cosine", "curvature"},
       {"skin-red", "skin-green", "skin-blue"},
       ggx,
       "Penner 2011; d'Eon and Luebke 2007"},
  };
}

bool holds(const std::vector<Quantity>& quantities, Quantity wanted) {
  return std::count(quantities.begin(), quantities.end(), wanted) > 0;
}

std::vector<Quantity> quantities_of(const TableRecipe& recipe) {
  std::vector<Quantity> quantities;
  for (const std::string& axis : recipe.axes) {
    const Quantity quantity = find_axis_mapping(axis).quantity;
    if (holds(quantities, quantity)) {
      throw Error(Fault::Usage, "axes: found " + quantity_name(quantity) + " twice");
    }
    quantities.push_back(quantity);
  }
  return quantities;
}

std::string list_of(const std::vector<Quantity>& quantities) {
  std::string text;
  for (const Quantity quantity : quantities) {
    if (!text.empty()) text += ", ";
    text += quantity_name(quantity);
  }
  return text;
}

void check_axes(const TableRecipe& recipe) {
  const std::vector<Quantity> found = quantities_of(recipe);
  std::vector<Quantity> wanted;
  for (const std::string& axis : find_table(recipe.table).axes) {
    wanted.push_back(find_axis_mapping(axis).quantity);
  }
  if (!std::is_permutation(found.begin(), found.end(), wanted.begin(), wanted.end())) {
    throw Error(Fault::Usage, "axes: found " + list_of(found) + "; " + recipe.table +
                                  " runs over " + list_of(wanted));
  }
  for (const std::string& name : recipe.channels) {
    for (const Quantity quantity : find_channel(name).over) {
      if (holds(found, quantity)) continue;
      throw Error(Fault::Usage, "channels: '" + name + "' runs over " +
                                    list_of(find_channel(name).over) + ", " + recipe.table +
                                    " over " + list_of(found));
    }
  }
}

}  // namespace

const std::vector<TableFacts>& all_tables() {
  static const std::vector<TableFacts> tables = make_list();
  return tables;
}

std::vector<std::string> table_names() {
  std::vector<std::string> names;
  for (const TableFacts& table : all_tables()) names.push_back(table.name);
  return names;
}

const TableFacts& find_table(const std::string& name) {
  return find_named(all_tables(), "table", name);
}

TableRecipe recipe_of(const TableFacts& facts) {
  TableRecipe recipe;
  recipe.table = facts.name;
  recipe.models.lobe = facts.lobe;
  recipe.size = facts.size;
  recipe.depth = facts.depth;
  return recipe;
}

void complete(TableRecipe& recipe) {
  const TableFacts& facts = find_table(recipe.table);
  const std::string& fresnel = recipe.models.fresnel.name;
  if (recipe.axes.empty()) recipe.axes = facts.axes;
  if (recipe.channels.empty()) {
    recipe.channels = facts.channels;
    if (recipe.table == "directional-albedo" && !fresnel.empty()) recipe.channels = {"reflectance"};
  }
  for (std::string& axis : recipe.axes) axis = find_axis_mapping(axis).name;
  for (std::string& channel : recipe.channels) channel = find_channel(channel).name;
  const bool reads_fresnel =
      std::count(recipe.channels.begin(), recipe.channels.end(), "reflectance") > 0;
  if (!reads_fresnel && !fresnel.empty() && fresnel != "schlick") {
    throw Error(Fault::Usage, "fresnel: " + recipe.table + " with these channels does not read '" +
                                  fresnel +
                                  "'; directional-albedo, or the channel reflectance, does");
  }
  if (recipe.axes.size() < 3) recipe.depth = 1;
  if (recipe.axes.size() < 2) recipe.size.height = 1;
  check_axes(recipe);
  LobeIntegrals(recipe.models.lobe, recipe.models.fresnel, Quality::Table);  // refuses a misfit
}

}  // namespace kiln
