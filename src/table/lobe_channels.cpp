// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "channel_lists.h"
#include "kiln/parallel/rows.h"

namespace kiln {
namespace {

using enum Quantity;

std::vector<double> alphas_of(const TableGrid& grid) {
  std::vector<double> alphas;
  alphas.reserve(grid.of(Roughness).size());
  for (const double roughness : grid.of(Roughness)) alphas.push_back(table_alpha(roughness));
  return alphas;
}

template <class Pick>
std::vector<double> fill_from(TableContext& context, const Lobe& lobe, const FresnelChoice& fresnel,
                              Pick&& pick) {
  LobeIntegrals& integrals = context.lobes.of(lobe, fresnel);
  const GridMeans means = integrals.means_for(context.whole.of(Mu), alphas_of(context.whole));
  const auto terms = integrals.grid(context.grid.of(Mu), alphas_of(context.grid), means);
  std::vector<double> values;
  values.reserve(terms.size());
  for (const LobeTerms& one : terms) values.push_back(pick(one));
  return values;
}

template <auto Pick>
std::vector<double> fill(TableContext& context) {
  return fill_from(context, context.models.lobe, {}, Pick);
}

// Averages cost 64 integrals each and need no field.
template <auto Pick>
std::vector<double> fill_average(TableContext& context) {
  const std::vector<double> alphas = alphas_of(context.grid);
  const LobeIntegrals& lobe = context.lobes.of(context.models.lobe, {});
  std::vector<double> values(alphas.size());
  for_rows(static_cast<int>(alphas.size()),
           [&](int j) { values[j] = Pick(lobe.average(alphas[j])); });
  return values;
}

double scale_of(const LobeTerms& terms) { return terms.scale; }
double bias_of(const LobeTerms& terms) { return terms.bias; }
double edge_of(const LobeTerms& terms) { return terms.edge; }
double total_of(const LobeTerms& terms) { return terms.total(); }
double missing_of(const LobeTerms& terms) { return std::max(1 - terms.total(), 0.0); }

std::vector<double> fill_reflectance(TableContext& context) {
  FresnelChoice fresnel = context.models.fresnel;
  if (fresnel.name.empty()) fresnel.name = "schlick";
  return fill_from(context, context.models.lobe, fresnel, scale_of);
}

// Sheen keeps the lobe it is given if that is a cloth's, and is Charlie's elsewhere.
Lobe sheen_lobe(const TableModels& models, const char* masking) {
  if (models.lobe.distribution == "charlie") return models.lobe;
  return {"charlie", masking, 0};
}

std::vector<double> fill_sheen(TableContext& context) {
  return fill_from(context, sheen_lobe(context.models, "neubelt"), {}, total_of);
}

std::vector<double> fill_sheen_clamped(TableContext& context) {
  return fill_from(context, {"charlie", "neubelt-clamped", 0}, {}, total_of);
}

template <int Value>
std::vector<double> fill_constant(TableContext&) {
  return {static_cast<double>(Value)};
}

FresnelChoice dielectric_of(const char* name, double f0) {
  const double root = std::sqrt(std::clamp(f0, 0.0, 0.9999));
  FresnelChoice fresnel{name, {}};
  fresnel.parameters.ior = (1 + root) / (1 - root);
  return fresnel;
}

// The dielectric of each F0, on [f0][roughness][mu].
std::vector<double> fill_dielectric(TableContext& context) {
  std::vector<double> values;
  for (const double f0 : context.grid.of(F0)) {
    const auto slice =
        fill_from(context, context.models.lobe, dielectric_of("dielectric", f0), scale_of);
    values.insert(values.end(), slice.begin(), slice.end());
  }
  return values;
}

// Means over the visible normals whose reflection leaves the surface: what Cycles interpolates by.
void append_shares(TableContext& context, const FresnelChoice& share, std::vector<double>& values) {
  const Lobe visible{context.models.lobe.distribution, visible_normals, context.models.lobe.shape};
  const auto slice = fill_from(context, visible, share, scale_of);
  values.insert(values.end(), slice.begin(), slice.end());
}

std::vector<double> fill_dielectric_share(TableContext& context) {
  std::vector<double> values;
  for (const double f0 : context.grid.of(F0)) {
    append_shares(context, dielectric_of(dielectric_share, f0), values);
  }
  return values;
}

std::vector<double> fill_schlick_share(TableContext& context) {
  std::vector<double> values;
  for (const double exponent : context.grid.of(Exponent)) {
    FresnelChoice share{schlick_share, {}};
    share.parameters.exponent = exponent;
    append_shares(context, share, values);
  }
  return values;
}

}  // namespace

void add_lobe_channels(std::vector<ChannelFacts>& list) {
  const std::vector<Quantity> plane = {Mu, Roughness};
  const std::vector<ChannelFacts> mine = {
      {"scale", {"a"}, "scale: multiplies F0", plane, fill<scale_of>},
      {"bias", {"b", "fresnel"}, "bias: multiplies F90", plane, fill<bias_of>},
      {"total", {"e", "albedo"}, "E: directional albedo", plane, fill<total_of>},
      {"complement", {"1-e"}, "1 - E: what one bounce loses", plane, fill<missing_of>},
      {"f82",
       {},
       "f82: INT c (1 - c)^6; times -a takes off Hoffman's edge tint",
       plane,
       fill<edge_of>},
      {"reflectance",
       {},
       "reflectance: of the lobe with its Fresnel term",
       plane,
       fill_reflectance},
      {"average", {"e-avg"}, "E_avg: average albedo", {Roughness}, fill_average<total_of>},
      {"average-bias", {"b-avg"}, "B_avg: average bias", {Roughness}, fill_average<bias_of>},
      {"sheen",
       {"cloth", "charlie"},
       "sheen: directional albedo of Charlie with Neubelt's masking; may exceed 1",
       plane,
       fill_sheen},
      {"sheen-clamped",
       {},
       "sheen: as sheen, its visibility never above 1 per unit",
       plane,
       fill_sheen_clamped},
      {"dielectric",
       {},
       "dielectric: reflectance of the lobe with the exact Fresnel of the index that has this F0",
       {Mu, Roughness, F0},
       fill_dielectric},
      {"dielectric-share",
       {},
       "share: of F90 in a dielectric's F0 + share (F90 - F0), a mean over visible normals",
       {Mu, Roughness, F0},
       fill_dielectric_share},
      {"schlick-share",
       {},
       "share: of F90 in Schlick's form with any exponent, a mean over visible normals",
       {Mu, Roughness, Exponent},
       fill_schlick_share},
      {"zero", {"0"}, "0", {}, fill_constant<0>},
      {"one", {"1"}, "1", {}, fill_constant<1>},
  };
  list.insert(list.end(), mine.begin(), mine.end());
}

}  // namespace kiln
