// SPDX-License-Identifier: Apache-2.0
#include "outputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "kiln/io/texture_file.h"
#include "kiln/parallel/rows.h"
#include "kiln/pipeline/report.h"
#include "kiln/store/publish.h"

namespace kiln {
namespace {

namespace fs = std::filesystem;

// Made for viewing: radiance goes through the display.
bool is_for_viewing(std::string_view format) { return format == "png" || format == "jpeg"; }

bool holds_alpha(std::string_view format) { return format != "jpeg" && format != "hdr"; }

void check_type(Product product, std::optional<PixelType> type, const fs::path& path) {
  const WritableFormat& format = writable_format(path);
  if ((product == Product::Numbers || product == Product::Maps) && format.name == "jpeg") {
    throw Error(Fault::Usage,
                "jpg loses numbers; expected exr, png, hdr, tif, dds, ktx2, npy, csv or h");
  }
  if (!type || std::count(format.types.begin(), format.types.end(), *type)) return;
  std::vector<std::string_view> held;
  for (const PixelType known : format.types) held.push_back(pixel_type_name(known));
  throw Error(Fault::Usage, fmt::format("type: {} does not hold {}, expected {}", format.name,
                                        pixel_type_name(*type), fmt::join(held, " or ")));
}

void keep_colors(Layers& image) {
  std::erase_if(image.layers,
                [](const Layer& layer) { return layer.name.find('.') != std::string::npos; });
}

// Colour times coverage, without the coverage: what a format without alpha can show.
void lay_over_black(Layers& image) {
  const auto found = std::find_if(image.layers.begin(), image.layers.end(),
                                  [](const Layer& layer) { return layer.name == "A"; });
  if (found == image.layers.end()) return;
  const Plane alpha = std::move(found->plane);
  image.layers.erase(found);
  for (Layer& layer : image.layers) {
    for (int y = 0; y < image.size.height; ++y) {
      float* row = layer.plane.row(y);
      for (int x = 0; x < image.size.width; ++x) row[x] *= alpha.at(x, y);
    }
  }
}

// Colour by the name of the Color Interop Forum; numbers are "data".
std::string color_name(const Plan& plan, const Task& task, std::string_view format) {
  if (task.product == Product::Numbers) return "data";
  if (task.product == Product::Picture && is_for_viewing(format)) return "";
  return plan.color.working;
}

// The type a file gets when nobody states one: numbers keep all they can, pictures what is usual.
PixelType usual_type(Product product, const fs::path& path) {
  const WritableFormat& format = writable_format(path);
  const bool small =
      product == Product::Picture && (is_for_viewing(format.name) || format.name == "openexr");
  return small ? format.types.front() : format.types.back();
}

// What the task asks for, else what the product prefers if the format holds it, else the usual.
PixelType chosen_type(const Task& task, const Artifact& artifact, const fs::path& path) {
  if (task.output.type) return *task.output.type;
  for (const PixelType held : writable_format(path).types) {
    if (pixel_type_name(held) == artifact.preferred_type) return held;
  }
  return usual_type(task.product, path);
}

Labels labels_of(const Artifact& artifact) {
  Labels labels;
  for (const auto& [name, coordinates] : artifact.axes) labels.axes.push_back({name, coordinates});
  labels.channels = artifact.channel_names;
  return labels;
}

WriteOptions options_of(const Plan& plan, const Task& task, const Artifact& artifact,
                        const fs::path& path) {
  const WritableFormat& format = writable_format(path);
  WriteOptions options;
  options.type = chosen_type(task, artifact, path);
  options.run = for_rows;
  options.depth = artifact.depth;
  options.labels = labels_of(artifact);
  if (!artifact.axes.empty()) options.packing = Packing::Fast;
  options.attributes = artifact.attributes;
  options.attributes.emplace_back("Software", software());
  const std::string color = color_name(plan, task, format.name);
  if (!color.empty()) options.attributes.emplace_back("colorInteropID", color);
  if (task.product != Product::Picture) return options;
  options.alpha = AlphaStorage::Premultiplied;
  const std::string& display = task.output.display.display;
  const bool srgb = display.empty() || display == "sRGB";
  if (is_for_viewing(format.name) && srgb) options.color_tag = ColorTag::Srgb;
  return options;
}

WriteFacts write_product(const Plan& plan, const Task& task, const Artifact& artifact,
                         const fs::path& path, const WriteOptions& options,
                         const ColorConfig& config) {
  if (area(artifact.bands.size) > 0) return write_bands(path, artifact.bands, options);
  if (task.product != Product::Picture) return write_image(path, artifact.image, options);
  const Shown shown = shown_by(task, artifact.view.has_value());
  Layers picture = shown == Shown::View ? *artifact.view : artifact.image;
  return write_image(path, stored_picture(plan, task, std::move(picture), shown, config), options);
}

std::string write_image_of(const Plan& plan, const Task& task, const Artifact& artifact,
                           const fs::path& path, const ColorConfig& config) {
  const WriteOptions options = options_of(plan, task, artifact, path);
  const WriteFacts facts = write_product(plan, task, artifact, path, options, config);
  return clamping_note(path, options.type, facts);
}

// The type of that name which the format holds.
PixelType type_held(const WritableTexture& format, const std::string& name) {
  for (const PixelType held : format.types) {
    if (pixel_type_name(held) == name) return held;
  }
  throw Error(Fault::Internal, fmt::format("{} does not hold {}", format.name, name));
}

// Babylon.js keeps a polynomial of the normal, without the constant that n.n = 1 makes redundant.
IrradiancePolynomial polynomial_of(const std::vector<Vec3<double>>& c) {
  const auto color = [](const Vec3<double>& v) {
    return IrradiancePolynomial::Color{v.x, v.y, v.z};
  };
  IrradiancePolynomial polynomial;
  polynomial.x = color(c[3]);
  polynomial.y = color(c[1]);
  polynomial.z = color(c[2]);
  polynomial.xx = color(c[0] - c[6] + c[8]);
  polynomial.yy = color(c[0] - c[6] - c[8]);
  polynomial.zz = color(c[0] + c[6] * 2.0);
  polynomial.xy = color(c[4]);
  polynomial.yz = color(c[5]);
  polynomial.zx = color(c[7]);
  return polynomial;
}

void write_texture_of(const Artifact& artifact, const fs::path& path) {
  const WritableTexture& format = writable_texture(path);
  const TextureProduct& product = *artifact.texture;
  TextureWriteOptions options;
  options.type = type_held(format, artifact.preferred_type);
  if (product.zstd) options.supercompression = Supercompression::Zstd;
  if (product.at_nodes) options.samples = Samples::Nodes;
  if (format.name == "ktx2") options.color_tag = ColorTag::Linear;
  if (format.holds_attributes) {
    options.attributes = artifact.attributes;
    options.attributes.emplace_back("Software", software());
  }
  if (product.irradiance.size() == 9) options.irradiance = polynomial_of(product.irradiance);
  write_texture(path, product.texture, options);
}

// Beside a file whose format has no room for them.
void write_attributes(const fs::path& path, const Artifact& artifact) {
  nlohmann::ordered_json json;
  for (const auto& [name, text] : artifact.attributes) json[name] = text;
  json["Software"] = software();
  publish_text(path, json.dump(2) + "\n");
}

bool needs_attributes_beside(const Artifact& artifact, const fs::path& path) {
  return !artifact.axes.empty() && !writable_format(path).holds_attributes;
}

std::string output_name(const Task& task, const Artifact& artifact) {
  if (task.product != Product::Folder) return task.out;
  const std::string extension = artifact.extension.empty() ? ".exr" : artifact.extension;
  const std::string name = artifact.name + extension;
  if (artifact.name.empty() || fs::path(name).filename() != name) {
    throw Error(Fault::Internal, "a product of the bake has no usable name: '" + name + "'");
  }
  return (fs::path(task.out) / name).lexically_normal().generic_string();
}

}  // namespace

bool is_for_viewing(const fs::path& path) { return is_for_viewing(writable_format(path).name); }

Shown shown_by(const Task& task, bool has_view) {
  const std::string_view format = writable_format(task.out).name;
  if (has_view && format == "hdr") {
    throw Error(Fault::Usage, "hdr holds no negative numbers; expected exr, tif, png or jpg");
  }
  return has_view && is_for_viewing(format) ? Shown::View : Shown::Radiance;
}

Layers stored_picture(const Plan& plan, const Task& task, Layers picture, Shown shown,
                      const ColorConfig& config) {
  const std::string_view format = writable_format(task.out).name;
  if (format == "openexr") return picture;
  keep_colors(picture);
  if (!holds_alpha(format)) lay_over_black(picture);
  if (shown == Shown::View || !is_for_viewing(format)) return picture;
  return config.to_display(picture, plan.color.working, task.output.display);
}

WriteOptions write_options(const Plan& plan, const Task& task, const Artifact& artifact) {
  return options_of(plan, task, artifact, plan.output / task.out);
}

std::string map_file_name(const Task& task, const std::string& map, const std::string& extension,
                          bool is_file, size_t files) {
  constexpr std::string_view suffix_mark = "{suffix}";
  std::string name = task.out;
  if (const size_t mark = name.find(suffix_mark); mark != std::string::npos) {
    name.replace(mark, suffix_mark.size(), map);
    return fs::path(name).has_extension() ? name : name + extension;
  }
  if (!is_file) return (fs::path(name) / (map + extension)).lexically_normal().generic_string();
  if (files == 1) return name;
  throw Error(Fault::Usage, fmt::format("out: found one file, '{}', but {} makes {}; expected a "
                                        "folder, or {} in the name",
                                        task.out, task.bake, files, suffix_mark));
}

PixelType held_type(const Task& task, const std::string& preferred,
                    const std::vector<PixelType>& held) {
  if (task.output.type) return *task.output.type;
  for (const PixelType type : held) {
    if (pixel_type_name(type) == preferred) return type;
  }
  return held.front();
}

std::string clamping_note(const fs::path& path, PixelType type, const WriteFacts& facts) {
  if (facts.clamped == 0) return "";
  return fmt::format("{}: {} finite values beyond the range of {} were clamped, the largest {:.6g}",
                     path.filename().string(), facts.clamped, pixel_type_name(type),
                     facts.largest_clamped);
}

bool names_an_image(const fs::path& path) {
  const std::string extension = kebab(path.extension().string());
  return std::any_of(writable_formats().begin(), writable_formats().end(), [&](const auto& format) {
    return std::count(format.extensions.begin(), format.extensions.end(), extension) > 0;
  });
}

void check_output(const Task& task) {
  const fs::path out(task.out);
  if (task.out.empty()) throw Error(Fault::Usage, "out: found nothing, expected a file or folder");
  if (out.is_absolute() || *out.begin() == "..") {
    throw Error(Fault::Usage, fmt::format("out: '{}' leaves the output folder", task.out));
  }
  if (*out.begin() == ".kiln") {
    throw Error(Fault::Usage, fmt::format("out: '{}' is where records are kept", task.out));
  }
  const std::string extension = out.extension().string();
  if (task.product == Product::Folder) {
    if (names_an_image(out)) {
      throw Error(Fault::Usage, fmt::format("out: found '{}', expected a folder: {} makes several "
                                            "files",
                                            task.out, task.bake));
    }
    return;
  }
  if (task.product == Product::Maps) {
    if (names_an_image(out)) check_type(task.product, task.output.type, out);
    return;
  }
  if (!out.has_filename() || extension.empty()) {
    throw Error(Fault::Usage,
                fmt::format("out: found '{}', expected a file name with an extension", task.out));
  }
  check_type(task.product, task.output.type, out);
}

bool collide(const std::string& a, const std::string& b) {
  const auto holds = [](const std::string& folder, const std::string& name) {
    return folder == "." ||
           (name.size() > folder.size() && name.starts_with(folder) && name[folder.size()] == '/');
  };
  return a == b || holds(a, b) || holds(b, a);
}

Written write_outputs(const Plan& plan, const Task& task, const Baked& baked,
                      const ColorConfig& config) {
  Written written;
  for (const Artifact& artifact : baked.artifacts) {
    const std::string name = output_name(task, artifact);
    const fs::path path = plan.output / name;
    if (!artifact.text.empty()) {
      publish_text(path, artifact.text);
    } else if (artifact.texture) {
      write_texture_of(artifact, path);
    } else {
      const std::string note = write_image_of(plan, task, artifact, path, config);
      if (!note.empty()) written.notes.push_back(note);
    }
    written.outputs.push_back(name);
    if (artifact.text.empty() && !artifact.texture && needs_attributes_beside(artifact, path)) {
      write_attributes(path.string() + ".json", artifact);
      written.outputs.push_back(name + ".json");
    }
  }
  return written;
}

Layers coded_as(const Layers& image, const std::string& pixel_type) {
  if (pixel_type == "rgbe") return coded_as_hdr(image);
  for (const WritableTexture& format : writable_textures()) {
    for (const PixelType type : format.types) {
      if (pixel_type_name(type) == pixel_type) return coded(image, type);
    }
  }
  throw Error(Fault::Internal, "no pixel type is named " + pixel_type);
}

}  // namespace kiln
