// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "kiln/bake/mip_sheet.h"
#include "kiln/bake/surface_choice.h"
#include "kiln/core/param.h"
#include "kiln/image/bands.h"
#include "kiln/image/layers.h"
#include "kiln/image/texture.h"
#include "kiln/material/map_bands.h"
#include "kiln/math/vec.h"

namespace kiln {

struct Svbrdf;
class Light;        // bake/products.h: an environment, ready to light with
class AlbedoTable;  // table/albedo_table.h

/// Once for the whole pipeline, or once per texture set.
enum class Scope { Once, PerSet };

/// What `out` of a bake names.
enum class Product {
  Numbers,  ///< a file of numbers, written as they are
  Picture,  ///< a file of radiance; formats made for viewing (png, jpg) get it through the display
  Folder,   ///< a folder of named files of numbers
  Maps      ///< a folder of maps, or a pattern with "{suffix}" in the place of a map's name
};

/// What a bake says of itself. Help, parsing, docs and tests follow from it.
struct BakeFacts {
  std::string name;     ///< "lut", "environment", "preview"
  std::string summary;  ///< one line
  Scope scope = Scope::Once;
  std::vector<ParamFacts> params;
  Product product = Product::Numbers;
  bool own_lights = false;  ///< its settings may hold lights that do without an environment
  std::string layout = {};  ///< the parameter that is a layout: of a preset or a file, its words
};

/// Maps of a set that are read band by band.
struct MapNeeds {
  bool resolved = false;          ///< as one BRDF per texel
  std::vector<Slot> stored = {};  ///< as stored, where they are given
  int made = 0;                   ///< planes that are made of them; 0: as many as are read
  double held = 0;                ///< planes of the set's size that are held beside the bands

  bool any() const { return resolved || !stored.empty(); }
};

/// What a bake reads besides its settings. A pointer it did not ask for is null.
struct Needs {
  bool material = false;  ///< the SVBRDF of the set
  /// So many texels of it each way are enough: larger sets may be halved until they come near.
  /// Without a width all are wanted.
  Size material_for = {};
  bool light = false;        ///< an environment (key `env`)
  bool sampled = false;      ///< its distribution of directions too
  bool prefiltered = false;  ///< and its specular chain and irradiance
  bool albedo = false;       ///< the directional-albedo table of the model
  bool own_lights = false;   ///< the settings hold lights: an environment may be missing
  MapNeeds maps = {};        ///< the maps of the set, band by band
  bool late_view = false;    ///< its sheet is a picture with a LateView
};

/// What a reader gets of an image that is stored as a pixel type of that name.
using Coded = std::function<Layers(const Layers&, const std::string& pixel_type)>;

struct Ingredients {
  const Svbrdf* material = nullptr;
  const Light* light = nullptr;
  const AlbedoTable* albedo = nullptr;
  const MapBands* maps = nullptr;
  SurfaceChoice surface = {};  ///< the models that the maps feed
  Coded coded = {};            ///< for bakes that state the error of an encoding
};

/// A texture with levels or faces, in the place of an image.
struct TextureProduct {
  Texture texture;
  bool zstd = false;      ///< supercompressed, where the format can be
  bool at_nodes = false;  ///< samples lie on the borders
  /// Irradiance over pi for shaders (scaled_for_shaders), where the format has a place for it.
  std::vector<Vec3<double>> irradiance;
};

/// One product: an image or a text. `name` is empty for the bake's single product (its file is the
/// task's `out`); otherwise it is the file's name without extension below the folder `out`.
struct Artifact {
  std::string name;
  std::string extension;  ///< with dot, forced ("." + json for texts); empty: the task's own
  Layers image;
  std::optional<TextureProduct> texture;  ///< when there, this is the product
  std::string text;                       ///< when not empty, this is the product
  /// Of a picture that no display shows as it is: what formats made for viewing hold instead, R G B
  /// [A] as a display that encodes as sRGB takes them.
  std::optional<Layers> view = {};
  std::vector<std::pair<std::string, std::string>> attributes;  ///< metadata of the file
  std::string preferred_type =
      {};         ///< "half": taken where the format holds it and none is asked for
  int depth = 1;  ///< slices of a volume, one below the other in the image
  std::vector<std::pair<std::string, std::vector<double>>> axes = {};  ///< of tables: x, y, z
  std::vector<std::string> channel_names = {};  ///< of tables: "scale", "bias"
  /// In place of the image, where it has a size: what need not be held whole. Numbers only.
  ImageBands bands = {};
  /// Of colours: the space that they are in, and the one that the file holds. Empty: numbers.
  std::string color_from = {}, color_to = {};
};

/// What the files of a sheet are when they are read back as one set.
struct SheetMaterial {
  Workflow workflow = Workflow::MetalRough;
  std::vector<Slot> slots;  ///< that the files fill, in their order
  std::vector<Slot>
      replaced;  ///< of the set, which the files stand for: its other maps stay beside
};

/// What the user should know of a product, and its numbers.
struct Told {
  std::vector<std::string> notes;
  std::vector<std::pair<std::string, double>> figures;  ///< "error of entries", 2e-9, ...
};

/// Artifact::view of a picture that is made a band of rows at a time, where all of it has to be
/// known before any is shown.
struct LateView {
  /// Of rows of the picture, what is kept of each pixel. May be called from many threads at once.
  std::function<Plane(const Layers& rows)> keep;
  /// The view, from what was kept of the whole picture.
  std::function<ImageBands(Plane kept)> paint;
};

/// Rows of a band of a MapSheet are a multiple of this, but the last's.
inline constexpr int band_unit = 16;

/// Files of one size that are made together, a band of rows at a time, from the maps of a set.
struct MapSheet {
  std::vector<Artifact> files;  ///< their images have no texels: names of layers
  /// The same rows of every file. May be called from many threads at once.
  std::function<std::vector<Layers>(const MapRows&)> make;
  /// Where it is there, `material.yaml` beside the files says how they are read back.
  std::optional<SheetMaterial> material = {};
  std::optional<LateView> view = {};  ///< of a picture
  /// Once all rows are made: what is to be told. Empty: nothing.
  std::function<Told()> told = {};
};

struct Baked {
  std::vector<Artifact> artifacts;
  std::optional<MapSheet> sheet = {};                   ///< of bakes that read maps band by band
  std::optional<MipSheet> mips = {};                    ///< likewise, with levels
  std::vector<std::string> notes;                       ///< what the user should know
  std::vector<std::pair<std::string, double>> figures;  ///< "error of entries", 2e-9, ...
};

/// A bake with its settings: filled in by name, then run. Pure: no files, no global state.
class Recipe {
 public:
  virtual ~Recipe() = default;
  virtual const BakeFacts& facts() const = 0;
  /// @error Fault::Usage with the nearest known parameter, or the range
  virtual void set(const std::string& name, const std::string& text) = 0;
  virtual Needs needs() const = 0;
  /// Whether the settings and these models, which fit each other, can be baked together.
  /// @error Fault::Usage
  virtual void check(const SurfaceChoice& surface) const = 0;
  virtual Baked bake(const Ingredients& ingredients) const = 0;
};

/// Every bake there is, in the order of the list.
const std::vector<BakeFacts>& all_bakes();

/// @error Fault::Usage, naming the nearest known bake
std::unique_ptr<Recipe> make_recipe(const std::string& bake);

}  // namespace kiln
