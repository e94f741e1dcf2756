// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "kiln/bake/surface_choice.h"
#include "kiln/color/color.h"
#include "kiln/image/arrangement.h"
#include "kiln/io/image_file.h"
#include "kiln/material/workflow.h"
#include "kiln/pipeline/document.h"

namespace kiln {

struct ColorChoice {
  std::string config;  ///< "builtin", a path, or empty: not stated
  std::string working = "lin_rec709_scene";
  enum class OnConversion { Allow, Warn, Refuse };
  OnConversion on_conversion = OnConversion::Warn;
};

struct EnvironmentChoice {
  std::string name;
  std::filesystem::path path;  ///< a file, six with <FACE> in the name, or a folder of six
  std::string color_space;     ///< empty: by type
  Arrangement projection = Arrangement::Auto;
  Mirror mirror = Mirror::None;
  Up up = Up::Y;
  double rotate = 0;  ///< [degree]
  std::string fix = "neighbors";
  Place place = {};
};

/// A slot that the user filled by hand.
struct MapChoice {
  Slot slot = Slot::BaseColor;
  std::filesystem::path path;  ///< empty: a constant
  std::string channel;         ///< empty: what the slot needs
  NormalConvention convention = NormalConvention::Auto;
  std::string color_space;  ///< empty: by type
  std::optional<std::array<float, 3>> value;
  std::optional<SpecularEncoding> encoding;
  SlotDecoding decoding = {};
  Place place = {};
};

/// An entry of `sets`: a pattern of folders or files; a folder, material file, document or packed
/// image; or maps by slot.
struct SetChoice {
  Place place;
  std::string glob;
  std::filesystem::path path;
  std::string material = {};  ///< of a document, the one that is wanted; empty: all
  std::string packed = {};    ///< of a lone image, its layout as parse_layout reads it
  std::string name;
  std::string chosen = {};  ///< the one of its sets that is wanted; empty: all
  std::vector<MapChoice> maps;
  std::vector<std::string> naming;  ///< empty: every scheme
  std::optional<Workflow> workflow;
  std::optional<double> alpha_cutoff;  ///< of a cutout
  WorkflowSettings reading;            ///< how maps are decoded; its workflow is decided later
};

struct MaterialChoice {
  std::optional<Workflow> workflow;  ///< empty: guessed from the maps
  SpecularEncoding specular = SpecularEncoding::Level;
  SurfaceChoice surface;  ///< the models that the maps feed
  Place place = {};
};

struct OutputChoice {
  std::optional<PixelType> type;
  ColorConfig::Display display;
};

/// A parameter of a bake as the user gave it.
struct Setting {
  std::string name;
  std::string text;
  Place place;
};

struct BakeChoice {
  Place place;
  std::string bake;
  std::string out;
  std::string env;
  Place env_place;
  OutputChoice output;
  std::vector<Setting> settings;
};

/// What a pipeline file says, or a command line that amounts to one: words checked, nothing looked
/// up yet. Relative paths have been joined to the folder of the file.
struct Pipeline {
  std::filesystem::path file;  ///< empty: from a command line
  std::string name;
  ColorChoice color;
  std::vector<EnvironmentChoice> environments;
  std::vector<SetChoice> sets;
  MaterialChoice material;
  std::vector<BakeChoice> bakes;
  long long max_memory = 0;  ///< [byte] that a run may take; 0: no limit
};

/// Reads and checks a pipeline file.
/// @param vars  "key" -> "value", over those of the file
/// @error Fault::Usage with every mistake found, one a line; Fault::Input when it cannot be read
Pipeline read_pipeline(const std::filesystem::path& file,
                       const std::vector<std::pair<std::string, std::string>>& vars = {});

/// A texture set in a file of its own: the blocks `maps` and `material`.
struct MaterialFile {
  SetChoice set;
  MaterialChoice material;
  std::vector<std::string> models;  ///< keys of its surface that it states
};
/// @error as read_pipeline
MaterialFile read_material_file(const std::filesystem::path& file);

/// An entry of `bakes` from keys and values, as a command line gives them.
/// @error Fault::Usage as for a file, without a place
BakeChoice bake_choice(const std::vector<std::pair<std::string, std::string>>& keys);

/// An entry of `environment`, likewise.
EnvironmentChoice environment_choice(const std::string& name,
                                     const std::vector<std::pair<std::string, std::string>>& keys);

/// A layout of packed files in the words that parse_layout reads: as it is where it is in such
/// words, else that of a preset, or of a file ("engines.yaml", "engines.yaml#mobile").
/// @param folder  that the file is relative to
/// @error Fault::Usage for unknown names, and for every mistake in the file, with its place;
///        Fault::Input when the file cannot be read
std::string layout_text(const std::string& text, const std::filesystem::path& folder);

/// Whether the name is that of such a file: .yaml, .yml or .json.
bool is_material_file(const std::filesystem::path& path);

/// Whether the name is that of a document of materials: .gltf, .glb or .mtlx.
bool is_material_document(const std::filesystem::path& path);

/// Which OpenColorIO config counts: the one asked for, else that of the file, else $OCIO, else the
/// builtin one.
std::string chosen_config(const std::string& asked_for, const std::string& of_file);

/// A path as the user wrote it, relative to a folder, without "." and "..".
std::filesystem::path joined(const std::filesystem::path& folder, const std::string& path);

}  // namespace kiln
