// SPDX-License-Identifier: Apache-2.0
#include "sheet_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <memory>

#include "kiln/io/image_file.h"
#include "kiln/parallel/rows.h"
#include "kiln/parallel/stages.h"
#include "kiln/pipeline/report.h"
#include "kiln/store/publish.h"
#include "material_text.h"
#include "memory.h"

namespace kiln {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view srgb = "srgb_rec709_scene";

WriteOptions options_of(const Task& task, const Artifact& artifact, const fs::path& path) {
  WriteOptions options;
  options.type = held_type(task, artifact.preferred_type, writable_format(path).types);
  options.attributes = artifact.attributes;
  options.attributes.emplace_back("Software", software());
  options.attributes.emplace_back("colorInteropID",
                                  artifact.color_to.empty() ? "data" : artifact.color_to);
  if (artifact.color_to == srgb) options.color_tag = ColorTag::Srgb;
  return options;
}

std::vector<std::string> names_of(const Layers& image) {
  std::vector<std::string> names;
  for (const Layer& layer : image.layers) names.push_back(layer.name);
  return names;
}

/// A file of a sheet on its way.
struct File {
  const Artifact& artifact;
  std::string name;
  PixelType type;
  std::unique_ptr<ImageWriter> writer;
};

std::vector<File> open_files(const Plan& plan, const Task& task, const MapSheet& sheet, Size size) {
  std::vector<File> files;
  for (const Artifact& artifact : sheet.files) {
    const std::string name = map_file_name(task, artifact.name, artifact.extension,
                                           names_an_image(task.out), sheet.files.size());
    for (const File& other : files) {
      if (other.name == name) {
        throw Error(Fault::Usage,
                    fmt::format("out: two files of {} would be named '{}'", task.bake, name));
      }
    }
    const fs::path path = plan.output / name;
    const WriteOptions options = options_of(task, artifact, path);
    files.push_back({artifact, name, options.type,
                     std::make_unique<ImageWriter>(path, size, names_of(artifact.image), options)});
  }
  return files;
}

// What reads the files back as one set, beside them.
void write_material(const Plan& plan, const Task& task, const MapSheet& sheet,
                    const MapBands& bands, Written& written) {
  const fs::path folder = (plan.output / written.outputs.front()).parent_path();
  std::vector<std::string> files;
  for (const std::string& name : written.outputs) {
    files.push_back(fs::path(name).filename().string());
  }
  const std::string name =
      fs::path(map_file_name(task, "material", ".yaml", false, 1)).replace_extension(".yaml");
  MaterialText material =
      material_text(sheet, files, plan.sets[*task.set], bands, folder.empty() ? "." : folder);
  publish_text(plan.output / name, material.text);
  written.outputs.push_back(name);
  std::move(material.notes.begin(), material.notes.end(), std::back_inserter(written.notes));
}

/// A band, from what is read to what is written.
struct Band {
  MapRows read;
  std::vector<Layers> made;
};

}  // namespace

Written write_sheet(const Plan& plan, const Task& task, const MapSheet& sheet, SetReader& reader,
                    const ColorConfig& config, const std::function<void()>& heed) {
  const Size size = reader.bands().size;
  const BandPlan bands = require_bands(cost_of_rows(plan, task), plan.max_memory);
  std::vector<File> files = open_files(plan, task, sheet, size);
  const auto make = [&](Band& band) {
    band.made = sheet.make(band.read);
    band.read.windows.clear();
    for (size_t i = 0; i < files.size(); ++i) {
      const Artifact& artifact = files[i].artifact;
      if (artifact.color_from == artifact.color_to) continue;
      config.convert(band.made[i], artifact.color_from, artifact.color_to);
    }
  };
  const auto write = [&](const Band& band) {
    for_rows(static_cast<int>(files.size()), [&](int i) {
      const auto at = static_cast<size_t>(i);
      files[at].writer->add(band.made[at]);
    });
  };
  run_stages<Band>(
      (size.height + bands.rows - 1) / bands.rows, bands.at_once,
      [&](int i) {
        heed();
        return Band{reader.next(std::min(bands.rows, size.height - i * bands.rows)), {}};
      },
      [&](int, Band& band) { make(band); }, [&](int, Band& band) { write(band); });
  Written written;
  for (File& file : files) {
    const WriteFacts facts = file.writer->finish();
    written.outputs.push_back(file.name);
    const std::string note = clamping_note(file.name, file.type, facts);
    if (!note.empty()) written.notes.push_back(note);
  }
  if (sheet.material) write_material(plan, task, sheet, reader.bands(), written);
  return written;
}

}  // namespace kiln
