// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kiln/bake/bake.h"
#include "kiln/brdf/fresnel.h"
#include "kiln/material/normal_filter.h"
#include "kiln/material/workflow.h"

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

/// Quantities of a set's BRDF, texel by texel.
struct DeriveBake {
  static constexpr const char* name = "derive";
  static constexpr const char* summary = "F0, diffuse and directional albedo, alpha of each texel";
  static constexpr Scope scope = Scope::PerSet;
  static constexpr Product product = Product::Maps;
  struct Settings {
    std::string quantities = "f0,diffuse_albedo,alpha,directional_albedo,energy_compensation";
    std::string angles = "0,60,80";
    std::string format;
  };
  static Params<Settings> params();
  static Needs needs(const Settings& settings);
  static Baked bake(const Settings& settings, const Ingredients& ingredients);
};

/// The maps of a set as another workflow wants them.
struct ConvertBake {
  static constexpr const char* name = "convert";
  static constexpr const char* summary = "a set's maps as another workflow wants them";
  static constexpr Scope scope = Scope::PerSet;
  static constexpr Product product = Product::Maps;
  enum class Method { Solve, Lossless, Khronos };
  struct Settings {
    Workflow to = Workflow::MetalRough;
    Method method = Method::Solve;
    std::string format;
  };
  static Params<Settings> params();
  static Needs needs(const Settings& settings);
  static Baked bake(const Settings& settings, const Ingredients& ingredients);
};

/// Several maps in the channels of one file.
struct PackBake {
  static constexpr const char* name = "pack";
  static constexpr const char* summary = "maps in the channels of files, as an engine wants them";
  static constexpr Scope scope = Scope::PerSet;
  static constexpr Product product = Product::Maps;
  static constexpr const char* layout = "layout";
  struct Settings {
    std::string preset = "gltf";
    std::string layout;
    std::string format;
  };
  static Params<Settings> params();
  static Needs needs(const Settings& settings);
  static Baked bake(const Settings& settings, const Ingredients& ingredients);
};

/// Each map of a set in a file of its own.
struct UnpackBake {
  static constexpr const char* name = "unpack";
  static constexpr const char* summary = "each map in a file of its own, bit for bit";
  static constexpr Scope scope = Scope::PerSet;
  static constexpr Product product = Product::Maps;
  struct Settings {
    std::string maps = "all";
    std::string format;
  };
  static Params<Settings> params();
  static Needs needs(const Settings& settings);
  static Baked bake(const Settings& settings, const Ingredients& ingredients);
};

/// Maps with all their levels.
struct MipsBake {
  static constexpr const char* name = "mips";
  static constexpr const char* summary = "maps with all their levels, roughness widened by normals";
  static constexpr Scope scope = Scope::PerSet;
  static constexpr Product product = Product::Maps;
  struct Settings {
    std::string map = "all";
    NormalFilter method = NormalFilter::Vmf;
    double strength = 1, threshold = 1;
    bool anisotropy = false;
    int levels = 0;
    double alpha_test = 0;
    std::string format;
  };
  static Params<Settings> params();
  static Needs needs(const Settings& settings);  ///< refuses settings that do not fit
  static Baked bake(const Settings& settings, const Ingredients& ingredients);
};

/// A normal map in another convention, or from height.
struct NormalBake {
  static constexpr const char* name = "normal";
  static constexpr const char* summary = "normal map in another convention, or from height";
  static constexpr Scope scope = Scope::PerSet;
  static constexpr Product product = Product::Maps;
  enum class From { Normal, Height };
  enum class To { OpenGl, DirectX };
  struct Settings {
    From from = From::Normal;
    To to = To::OpenGl;
    bool two_channel = false;
    bool renormalize = false;
    double height_scale = 0.01;
    double tile_size = 1;
    std::string format;
  };
  static Params<Settings> params();
  static Needs needs(const Settings& settings);
  static Baked bake(const Settings& settings, const Ingredients& ingredients);
};

/// Ambient occlusion from height.
struct OcclusionBake {
  static constexpr const char* name = "occlusion";
  static constexpr const char* summary = "ambient occlusion from height";
  static constexpr Scope scope = Scope::PerSet;
  static constexpr Product product = Product::Maps;
  struct Settings {
    double height_scale = 0.01;
    double tile_size = 1;
    double radius = 0.05;
    int directions = 16;
    std::string format;
  };
  static Params<Settings> params();
  static Needs needs(const Settings& settings);
  static Baked bake(const Settings& settings, const Ingredients& ingredients);
};

}  // namespace kiln
