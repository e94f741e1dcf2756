// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kiln/bake/bake.h"
#include "kiln/brdf/fresnel.h"

namespace kiln {

// Each bake is a struct with a name, a summary, a scope, its Settings and three functions. They are
// declared here and listed in bake.cpp; a new one is a file and a line on that list.

/// A table of BRDF integrals.
struct LutBake {
  static constexpr const char* name = "lut";
  static constexpr const char* summary = "lookup table of BRDF integrals, with its error";
  static constexpr Scope scope = Scope::Once;
  static constexpr Product product = Product::Numbers;
  struct Settings {
    std::string table = "split-sum", preset;
    Size size{};                                 ///< 0: the preset's, or 128x128
    int depth = 0;                               ///< 0: 16
    std::string axes, align, origin, channels;   ///< empty: the preset's or the table's
    std::string distribution, masking, fresnel;  ///< likewise
    double shape = 0;
    FresnelChannel<double> fresnel_numbers = {};
    bool exact = false;
  };
  static Params<Settings> params();
  static Needs needs(const Settings& settings);  ///< none; refuses words that do not fit
  static Baked bake(const Settings& settings, const Ingredients& ingredients);
};

/// An environment as an engine wants it: a prefiltered specular chain, irradiance and harmonics.
struct EnvironmentBake {
  static constexpr const char* name = "environment";
  static constexpr const char* summary = "prefiltered specular chain, irradiance and harmonics";
  static constexpr Scope scope = Scope::Once;
  static constexpr Product product = Product::Folder;
  struct Settings {
    std::string preset;
    int size = 256;
    std::string layout, curve, format, encoding, supercompression;  ///< "": the preset's
    std::string distribution;
    double shape = 0;
    std::string axes;
    int sh_order = 2;
    std::string sh_window;
  };
  static Params<Settings> params();
  static Needs needs(const Settings& settings);  ///< refuses settings that do not fit
  static Baked bake(const Settings& settings, const Ingredients& ingredients);
};

/// A lit picture of a texture set.
struct PreviewBake {
  static constexpr const char* name = "preview";
  static constexpr const char* summary =
      "lit picture of a texture set, flat, on a ball, or a sheet of both";
  static constexpr Scope scope = Scope::PerSet;
  static constexpr Product product = Product::Picture;
  static constexpr bool own_lights = true;
  enum class Shape { Flat, Sphere, Contact };
  enum class Mode { Reference, SplitSum, Difference };
  struct Settings {
    Shape shape = Shape::Flat;
    Mode mode = Mode::Reference;
    int samples = 64;
    double target_error = 0;
    Size size{0, 0};
    std::string view;  ///< "": 0,0; the plane of a contact sheet 45,-90
    double rotate = 0;
    std::string lights = {};  ///< directional, see parse_lights
    int seed = 0;
  };
  static Params<Settings> params();
  static Needs needs(const Settings& settings);
  static void check(const Settings& settings, const SurfaceChoice& surface);
  static Baked bake(const Settings& settings, const Ingredients& ingredients);
};

}  // namespace kiln
