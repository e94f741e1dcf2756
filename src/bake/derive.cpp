// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>

#include "bakes.h"
#include "kiln/table/albedo_table.h"
#include "map_files.h"
#include "word_list.h"

namespace kiln {
namespace {

using Settings = DeriveBake::Settings;

/// What quantities are computed from.
struct Source {
  const Svbrdf& rows;
  const AlbedoTable& albedo;
  float f90;
  float mu;  ///< cosine of the angle that the quantity is for
};

using Fill = std::vector<Plane> (*)(const Source& source);

struct Quantity {
  const char* name;
  const char* meaning;
  bool is_color;   ///< of reflectance, in the working space
  bool of_angles;  ///< one map for each angle
  int channels;
  Fill fill;
};

std::vector<Plane> copies(const std::array<Plane, 3>& planes) {
  return {planes.begin(), planes.end()};
}

std::vector<Plane> alpha_of(const Source& source) {
  Plane alpha = source.rows.roughness;
  for (int y = 0; y < alpha.height(); ++y) {
    float* row = alpha.row(y);
    for (int x = 0; x < alpha.width(); ++x) row[x] *= row[x];
  }
  return {std::move(alpha)};
}

// value(terms of the lobe at mu, F0) for each channel of each texel.
template <class Value>
std::vector<Plane> from_terms(const Source& source, const Value& value) {
  constexpr int lanes = lane_count<WideFloat>;
  const Size size = source.rows.size;
  std::vector<Plane> planes(3, Plane(size));
  for (int y = 0; y < size.height; ++y) {
    const float* roughness = source.rows.roughness.row(y);
    for (int x = 0; x < size.width; x += lanes) {
      const auto row = source.albedo.row(load_lanes<WideFloat>(roughness + x));
      const SplitSumTerms<WideFloat> terms = source.albedo.terms(row, WideFloat(source.mu));
      for (size_t c = 0; c < 3; ++c) {
        const auto f0 = load_lanes<WideFloat>(source.rows.f0[c].row(y) + x);
        store_lanes(planes[c].row(y) + x, value(terms, f0));
      }
    }
  }
  return planes;
}

std::vector<Plane> directional_albedo(const Source& source) {
  const WideFloat f90(source.f90);
  return from_terms(source, [f90](const SplitSumTerms<WideFloat>& terms, WideFloat f0) {
    return fma(f0, terms.scale, f90 * terms.bias);
  });
}

std::vector<Plane> energy_compensation(const Source& source) {
  return from_terms(source, [](const SplitSumTerms<WideFloat>& terms, WideFloat f0) {
    const WideFloat e = min(terms.total(), WideFloat(1.0f));
    return fma(f0, (WideFloat(1.0f) - e) / max(e, WideFloat(1e-6f)), WideFloat(1.0f));
  });
}

// THE list of quantities.
constexpr std::array quantities{
    Quantity{"f0", "specular reflectance at normal incidence", true, false, 3,
             [](const Source& source) { return copies(source.rows.f0); }},
    Quantity{"diffuse_albedo", "diffuse reflectance", true, false, 3,
             [](const Source& source) { return copies(source.rows.diffuse_color); }},
    Quantity{"alpha", "roughness squared", false, false, 1, alpha_of},
    Quantity{"directional_albedo", "what the specular lobe reflects in total, first bounce", true,
             true, 3, directional_albedo},
    Quantity{"energy_compensation", "1 + F0 (1/E - 1), which multiplies the first bounce", false,
             true, 3, energy_compensation}};

std::vector<std::string> quantity_names() {
  std::vector<std::string> names;
  names.reserve(quantities.size());
  for (const Quantity& quantity : quantities) names.emplace_back(quantity.name);
  return names;
}

std::vector<double> angles_of(const Settings& settings) {
  std::vector<double> angles = number_list("angles", settings.angles);
  for (const double angle : angles) {
    if (angle >= 0 && angle < 90) continue;
    throw Error(Fault::Usage, fmt::format("angles: found {}, expected [0, 90) degrees", angle));
  }
  return angles;
}

/// One file: a quantity, at one angle.
struct Wanted {
  const Quantity* quantity;
  double angle_deg = 0;

  std::string name() const {
    return quantity->of_angles ? fmt::format("{}_{:g}", quantity->name, angle_deg)
                               : std::string(quantity->name);
  }
};

std::vector<Wanted> wanted_by(const Settings& settings) {
  const std::vector<std::string> names =
      word_list("quantities", settings.quantities, quantity_names());
  std::vector<Wanted> wanted;
  for (const Quantity& quantity : quantities) {
    if (!std::count(names.begin(), names.end(), quantity.name)) continue;
    if (!quantity.of_angles) {
      wanted.push_back({&quantity});
      continue;
    }
    for (const double angle : angles_of(settings)) wanted.push_back({&quantity, angle});
  }
  return wanted;
}

}  // namespace

Params<Settings> DeriveBake::params() {
  return {
      text_param("quantities", &Settings::quantities,
                 fmt::format("what to make, any of {}", fmt::join(quantity_names(), ", "))),
      text_param("angles", &Settings::angles,
                 "from the normal, of directional quantities [degree]"),
      choice_param("format", &Settings::format, map_formats(), "of the files; by the maps' own")};
}

Needs DeriveBake::needs(const Settings& settings) {
  int planes = 0;
  for (const Wanted& one : wanted_by(settings)) planes += one.quantity->channels;
  return {.albedo = true, .maps = {.resolved = true, .made = planes}};
}

Baked DeriveBake::bake(const Settings& settings, const Ingredients& ingredients) {
  const MapBands& maps = *ingredients.maps;
  const std::vector<Wanted> wanted = wanted_by(settings);
  const std::string extension = settings.format.empty() ? ".exr" : "." + settings.format;
  Baked baked;
  MapSheet& sheet = baked.sheet.emplace();
  for (const Wanted& one : wanted) {
    Artifact file =
        one.quantity->is_color
            ? color_file(one.name(), extension, maps)
            : map_file(one.name(), extension,
                       one.quantity->channels == 1 ? std::vector<std::string>{"Y"}
                                                   : std::vector<std::string>{"R", "G", "B"});
    file.attributes.emplace_back("kiln:models", surface_words(ingredients.surface));
    sheet.files.push_back(std::move(file));
  }
  const AlbedoTable& albedo = *ingredients.albedo;
  const auto f90 = static_cast<float>(ingredients.surface.f90);
  sheet.make = [&maps, &albedo, wanted, f90](const MapRows& rows) {
    const Svbrdf svbrdf = maps.svbrdf(rows);
    std::vector<Layers> made;
    for (const Wanted& one : wanted) {
      const auto mu = static_cast<float>(std::cos(one.angle_deg * pi / 180));
      std::vector<Plane> planes = one.quantity->fill({svbrdf, albedo, f90, mu});
      made.push_back(one.quantity->channels == 1 ? layers_of(std::move(planes), {"Y"})
                                                 : layers_of(std::move(planes), {"R", "G", "B"}));
    }
    return made;
  };
  baked.notes.emplace_back(
      "directional quantities take Schlick's Fresnel, with F90 of the surface");
  return baked;
}

}  // namespace kiln
