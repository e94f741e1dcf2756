// SPDX-License-Identifier: Apache-2.0
#include "outputs.h"

#include <fmt/format.h>

#include <algorithm>

#include "kiln/pipeline/report.h"
#include "kiln/store/publish.h"

namespace kiln {
namespace {

namespace fs = std::filesystem;

struct Format {
  std::string extension;
  std::vector<PixelType> types;  ///< that it holds
  PixelType picture, numbers;    ///< usual for each product
};

const std::vector<Format>& formats() {
  using enum PixelType;
  static const std::vector<Format> list = {{".exr", {Half, Float}, Half, Float},
                                           {".png", {Uint8, Uint16}, Uint8, Uint16},
                                           {".jpg", {Uint8}, Uint8, Uint8},
                                           {".jpeg", {Uint8}, Uint8, Uint8},
                                           {".hdr", {Float}, Float, Float},
                                           {".tif", {Uint8, Uint16, Half, Float}, Float, Float},
                                           {".tiff", {Uint8, Uint16, Half, Float}, Float, Float}};
  return list;
}

bool is_jpeg(const std::string& extension) { return extension == ".jpg" || extension == ".jpeg"; }

// Made for viewing: radiance goes through the display.
bool is_for_viewing(const std::string& extension) {
  return extension == ".png" || is_jpeg(extension);
}

bool is_format(const std::string& extension) {
  return std::any_of(formats().begin(), formats().end(),
                     [&](const Format& format) { return format.extension == extension; });
}

const Format& format_of(const std::string& extension) {
  std::vector<std::string> known;
  for (const Format& format : formats()) {
    if (format.extension == extension) return format;
    known.push_back(format.extension);
  }
  throw Error(Fault::Usage, unknown_name("file extension", extension, known));
}

void check_type(Product product, std::optional<PixelType> type, const std::string& extension) {
  const Format& format = format_of(extension);
  if (product == Product::Numbers && is_jpeg(extension)) {
    throw Error(Fault::Usage, "jpg loses numbers; expected exr, png, hdr or tif");
  }
  if (!type) return;
  if (std::count(format.types.begin(), format.types.end(), *type)) return;
  std::vector<std::string_view> held;
  for (const PixelType known : format.types) held.push_back(pixel_type_name(known));
  throw Error(Fault::Usage, fmt::format("type: {} does not hold {}, expected {}", extension,
                                        pixel_type_name(*type), fmt::join(held, " or ")));
}

Layers colors_only(const Layers& image) {
  Layers kept{image.size, {}};
  for (const Layer& layer : image.layers) {
    if (layer.name.find('.') == std::string::npos) kept.layers.push_back(layer);
  }
  return kept;
}

// Colour by the name of the Color Interop Forum; numbers are "data".
std::string color_name(const Plan& plan, const Task& task, const std::string& extension) {
  if (task.product == Product::Numbers) return "data";
  if (task.product == Product::Picture && is_for_viewing(extension)) return "";
  return plan.color.working;
}

WriteOptions write_options(const Plan& plan, const Task& task, const Artifact& artifact,
                           const std::string& extension) {
  WriteOptions options;
  options.type = task.output.type.value_or(usual_type(task.product, extension));
  options.attributes = artifact.attributes;
  options.attributes.emplace_back("Software", software());
  const std::string color = color_name(plan, task, extension);
  if (!color.empty()) options.attributes.emplace_back("colorInteropID", color);
  return options;
}

std::string write_image_of(const Plan& plan, const Task& task, const Artifact& artifact,
                           const fs::path& path, const ColorConfig& config) {
  const std::string extension = path.extension().string();
  const WriteOptions options = write_options(plan, task, artifact, extension);
  const bool shown = task.product == Product::Picture && is_for_viewing(extension);
  const WriteFacts facts =
      shown ? write_image(path,
                          config.to_display(colors_only(artifact.image), plan.color.working,
                                            task.output.display),
                          options)
            : write_image(path, artifact.image, options);
  if (facts.clamped == 0) return "";
  return fmt::format("{}: {} finite values beyond the range of {} were clamped",
                     path.filename().string(), facts.clamped, pixel_type_name(options.type));
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
    if (is_format(extension)) {
      throw Error(Fault::Usage, fmt::format("out: found '{}', expected a folder: {} makes several "
                                            "files",
                                            task.out, task.bake));
    }
    return check_type(task.product, task.output.type, ".exr");
  }
  if (!out.has_filename() || extension.empty()) {
    throw Error(Fault::Usage,
                fmt::format("out: found '{}', expected a file name with an extension", task.out));
  }
  check_type(task.product, task.output.type, extension);
}

bool collide(const std::string& a, const std::string& b) {
  const auto holds = [](const std::string& folder, const std::string& name) {
    return folder == "." ||
           (name.size() > folder.size() && name.starts_with(folder) && name[folder.size()] == '/');
  };
  return a == b || holds(a, b) || holds(b, a);
}

PixelType usual_type(Product product, const std::string& extension) {
  const Format& format = format_of(extension);
  return product == Product::Numbers ? format.numbers : format.picture;
}

Written write_outputs(const Plan& plan, const Task& task, const Baked& baked,
                      const ColorConfig& config) {
  Written written;
  for (const Artifact& artifact : baked.artifacts) {
    const std::string name = output_name(task, artifact);
    const fs::path path = plan.output / name;
    if (!artifact.text.empty()) {
      publish_text(path, artifact.text);
    } else {
      const std::string note = write_image_of(plan, task, artifact, path, config);
      if (!note.empty()) written.notes.push_back(note);
    }
    written.outputs.push_back(name);
  }
  return written;
}

}  // namespace kiln
