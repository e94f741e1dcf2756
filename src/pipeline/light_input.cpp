// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>

#include "color_reading.h"
#include "face_files.h"
#include "inputs.h"
#include "kiln/image/arrangement.h"
#include "kiln/io/texture_file.h"
#include "kiln/material/slots.h"
#include "kiln/parallel/rows.h"

namespace kiln {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view faces_like_opengl =
    "in OpenGL's orientation, where text reads mirrored; if it does not, state mirror x";

std::vector<std::string> color_channels(const std::vector<std::string>& names) {
  return picked_names(names, has_channels(names, "rgb") ? "rgb" : "r");
}

// Planes by the names of the channels that were asked for, as R G B.
Layers named_rgb(Layers image, const std::vector<std::string>& channels) {
  if (image.layers.size() == 1) return as_rgb(std::move(image));
  Layers result{image.size, {}};
  for (size_t i = 0; i < channels.size(); ++i) {
    const auto found = std::find_if(image.layers.begin(), image.layers.end(),
                                    [&](const Layer& layer) { return layer.name == channels[i]; });
    result.layers.push_back({std::string(1, "RGB"[i]), std::move(found->plane)});
  }
  return result;
}

/// Reads the file or the files of one environment.
class LightReader {
 public:
  LightReader(const EnvironmentChoice& environment, const ColorChoice& color,
              const ColorConfig& config, EnvironmentRecord& record)
      : environment_(environment), color_(color), config_(config), record_(record) {}

  SphereImage read() {
    if (const auto files = face_files(environment_.path)) return read_faces(*files);
    return read_one();
  }

 private:
  SphereImage read_one() {
    const FileFacts facts = inspect_image(environment_.path);
    if (may_be_texture(facts.format)) {
      if (auto sphere = read_texture_cube(facts)) return *std::move(sphere);
    }
    const ImageMarks marks{facts.size, facts.envmap, facts.node_aligned};
    const std::string path = environment_.path.string();
    const ArrangementChoice choice =
        with_context(path, [&] { return choose_arrangement(environment_.projection, marks); });
    note(facts, "");
    Layers image = read_color(environment_.path, facts);
    SphereImage sphere =
        with_context(path, [&] { return arranged(std::move(image), choice.arrangement, marks); });
    record_.notes.push_back(described(sphere, choice, marks));
    return sphere;
  }

  static bool may_be_texture(const std::string& format) {
    return format == "ktx" || format == "ktx2" || format == "dds" || format == "env";
  }

  // The largest level of a cube texture; nothing where the file holds no cube.
  std::optional<SphereImage> read_texture_cube(const FileFacts& facts) {
    TextureFile file = read_texture(environment_.path);
    if (!file.texture.is_cube()) return std::nullopt;
    require_faces_wanted("a cube texture");
    note(file.facts, "");
    std::vector<Layers> faces;
    for (Layers& face : file.texture.levels.front()) {
      const std::vector<std::string> channels = color_channels(facts.channels);
      faces.push_back(named_rgb(std::move(face), channels));
      bring_to_working(file.facts.type, faces.back());
    }
    SphereImage sphere = cube_image(std::move(faces), file.facts.node_aligned);
    const int n = sphere.size().width;
    record_.notes.push_back(
        fmt::format("projection cube-faces: the largest of {} levels of a {} texture, "
                    "faces of {} x {}, {}",
                    file.texture.levels.size(), facts.format, n, n, faces_like_opengl));
    return sphere;
  }

  // That the projection asked for, if any, is that of faces.
  void require_faces_wanted(std::string_view found) const {
    if (environment_.projection == Arrangement::Auto ||
        environment_.projection == Arrangement::CubeFaces) {
      return;
    }
    throw Error(Fault::Input,
                fmt::format("{}, expected one image (projection {})", found,
                            arrangement_names[static_cast<size_t>(environment_.projection)]));
  }

  SphereImage read_faces(const FaceFiles& files) {
    with_context(environment_.path.string(), [&] { require_faces_wanted("six files"); });
    std::vector<Layers> faces;
    bool node_aligned = true;
    for (const fs::path& path : files.paths) {
      const FileFacts facts = inspect_image(path);
      node_aligned = node_aligned && facts.node_aligned;
      note(facts, path.filename().string() + ": ");
      faces.push_back(with_context(path.string(), [&] { return read_color(path, facts); }));
    }
    SphereImage sphere = with_context(environment_.path.string(),
                                      [&] { return cube_image(std::move(faces), node_aligned); });
    const int n = sphere.size().width;
    record_.notes.push_back(fmt::format(
        "projection cube-faces: six files {} of {} x {}{}; {} are px nx py ny pz nz, {}",
        files.pattern, n, n, borders(sphere), files.naming, faces_like_opengl));
    return sphere;
  }

  // No more of the file than its colour ever is in memory.
  Layers read_color(const fs::path& path, const FileFacts& facts) {
    const std::vector<std::string> channels = color_channels(facts.channels);
    Layers image = named_rgb(read_image(path, {}, channels, for_rows).image, channels);
    bring_to_working(facts.type, image);
    return image;
  }

  void bring_to_working(PixelType type, Layers& image) {
    const std::string from = space_of(environment_.color_space, type);
    config_.convert(image, from, color_.working);
    record_.color = conversion_text(from, color_.working);
  }

  void note(const FileFacts& facts, const std::string& before) {
    for (const std::string& text : facts.notes) record_.notes.push_back(before + text);
  }

  static std::string_view borders(const SphereImage& sphere) {
    return sphere.node_aligned ? ", samples on their borders" : "";
  }

  static std::string described(const SphereImage& sphere, const ArrangementChoice& choice,
                               const ImageMarks& marks) {
    const std::string_view name = arrangement_names[static_cast<size_t>(choice.arrangement)];
    const auto [width, height] = sphere.size();
    switch (sphere.projection) {
      case SphereImage::Projection::LatLong:
        return fmt::format("projection {}: {} x {} ({}){}", name, width, height, choice.reason,
                           sphere.node_aligned ? ", samples on the borders" : "");
      case SphereImage::Projection::Octahedral:
        return fmt::format("projection {}: {} x {} ({}), +Y in the middle, -Y in the corners", name,
                           width, height, choice.reason);
      case SphereImage::Projection::Cube:
        break;
    }
    return fmt::format(
        "projection {}: six faces px nx py ny pz nz of {} x {} ({}){}, {}", name, width, height,
        choice.reason, borders(sphere),
        marks.envmap == Envmap::Cube ? "in OpenEXR's orientation" : faces_like_opengl);
  }

  const EnvironmentChoice& environment_;
  const ColorChoice& color_;
  const ColorConfig& config_;
  EnvironmentRecord& record_;
};

}  // namespace

LoadedLight load_light(const EnvironmentChoice& environment, const ColorChoice& color,
                       const ColorConfig& config, const LightSettings& settings) {
  LoadedLight loaded;
  loaded.record.name = environment.name;
  loaded.record.source = environment.path.string();
  SphereImage image = LightReader(environment, color, config, loaded.record).read();
  loaded.record.notes.push_back(fmt::format(
      "mirror {}, up {}, rotate {:g}", mirror_names[static_cast<size_t>(environment.mirror)],
      up_names[static_cast<size_t>(environment.up)], environment.rotate));
  LightSettings chosen = settings;
  chosen.mirror = environment.mirror;
  chosen.up = environment.up;
  chosen.rotate_deg = environment.rotate;
  chosen.fix = environment.fix;
  chosen.notes = loaded.record.notes;
  loaded.made =
      with_context(loaded.record.source, [&] { return make_light(std::move(image), chosen); });
  loaded.record.warnings = loaded.made.notes;
  return loaded;
}

}  // namespace kiln
