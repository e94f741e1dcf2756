// SPDX-License-Identifier: Apache-2.0
#include "sheet_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <memory>
#include <utility>

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

WriteOptions options_of_map(const Task& task, const Artifact& artifact, const fs::path& path) {
  WriteOptions options;
  options.run = for_rows;
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
  std::string name;
  PixelType type;
  std::function<Layers(Layers)> stored;  ///< rows that are made, as the file holds them
  std::unique_ptr<ImageWriter> writer;
};

/// What files are made by.
struct Making {
  const Plan& plan;
  const Task& task;
  const MapSheet& sheet;
  const ColorConfig& config;
};

File open_file(const Making& making, const std::string& name, const Artifact& artifact, Size size,
               const WriteOptions& options, std::function<Layers(Layers)> stored) {
  const Layers texel = make_layers({1, 1}, names_of(artifact.image));
  const std::vector<std::string> names = names_of(stored(texel));
  return {name, options.type, std::move(stored),
          std::make_unique<ImageWriter>(making.plan.output / name, size, names, options)};
}

File open_picture(const Making& making, Size size) {
  const Artifact& artifact = making.sheet.files.front();
  const auto stored = [making](Layers rows) {
    return stored_picture(making.plan, making.task, std::move(rows), Shown::Radiance,
                          making.config);
  };
  return open_file(making, making.task.out, artifact, size,
                   write_options(making.plan, making.task, artifact), stored);
}

File open_map(const Making& making, const Artifact& artifact, Size size) {
  const auto& [plan, task, sheet, config] = making;
  const std::string name = map_file_name(task, artifact.name, artifact.extension,
                                         names_an_image(task.out), sheet.files.size());
  const auto stored = [&artifact, &config = config](Layers rows) {
    if (artifact.color_from != artifact.color_to) {
      config.convert(rows, artifact.color_from, artifact.color_to);
    }
    return rows;
  };
  return open_file(making, name, artifact, size, options_of_map(task, artifact, plan.output / name),
                   stored);
}

void require_own_names(const std::string& bake, const std::vector<File>& files) {
  for (size_t i = 0; i < files.size(); ++i) {
    for (size_t j = 0; j < i; ++j) {
      if (files[i].name != files[j].name) continue;
      throw Error(Fault::Usage,
                  fmt::format("out: two files of {} would be named '{}'", bake, files[i].name));
    }
  }
}

std::vector<File> open_files(const Making& making, Size size) {
  std::vector<File> files;
  if (making.task.product == Product::Picture) {
    files.push_back(open_picture(making, size));
    return files;
  }
  files.reserve(making.sheet.files.size());
  for (const Artifact& artifact : making.sheet.files) {
    files.push_back(open_map(making, artifact, size));
  }
  require_own_names(making.task.bake, files);
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

/// Reads all rows of a set; make(Band) and then write(Band), in order, for each band.
template <class Make, class Write>
void run_bands(SetReader& reader, const BandPlan& bands, const std::function<void()>& heed,
               const Make& make, const Write& write) {
  const int height = reader.bands().size.height;
  run_stages<Band>((height + bands.rows - 1) / bands.rows, bands.at_once,
                   [&](int i) {
                     heed();
                     return Band{reader.next(std::min(bands.rows, height - i * bands.rows)), {}};
                   },
                   [&](int, Band& band) {
                     make(band);
                     band.read.windows.clear();
                   },
                   [&](int, Band& band) { write(band); });
}

void note_clamping(const std::string& name, PixelType type, const WriteFacts& facts,
                   Written& written) {
  written.outputs.push_back(name);
  const std::string note = clamping_note(name, type, facts);
  if (!note.empty()) written.notes.push_back(note);
}

Written write_files(const Making& making, SetReader& reader, const BandPlan& bands,
                    const std::function<void()>& heed) {
  std::vector<File> files = open_files(making, reader.bands().size);
  const auto make = [&](Band& band) {
    band.made = making.sheet.make(band.read);
    for (size_t i = 0; i < files.size(); ++i) {
      band.made[i] = files[i].stored(std::move(band.made[i]));
    }
  };
  const auto write = [&](const Band& band) {
    for_rows(static_cast<int>(files.size()), [&](int i) {
      const auto at = static_cast<size_t>(i);
      files[at].writer->add(band.made[at]);
    });
  };
  run_bands(reader, bands, heed, make, write);
  Written written;
  for (File& file : files) note_clamping(file.name, file.type, file.writer->finish(), written);
  if (making.sheet.material) {
    write_material(making.plan, making.task, making.sheet, reader.bands(), written);
  }
  return written;
}

// All of the picture is made before any of the file is.
Written write_late_view(const Making& making, SetReader& reader, const BandPlan& bands,
                        const std::function<void()>& heed) {
  Plane kept(reader.bands().size);
  const auto make = [&](const Band& band) {
    const Plane rows = making.sheet.view->keep(making.sheet.make(band.read).front());
    for (int y = 0; y < rows.height(); ++y) {
      const auto row = rows.texels_of_row(y);
      std::copy(row.begin(), row.end(), kept.row(band.read.rows.first + y));
    }
  };
  run_bands(reader, bands, heed, make, [](const Band&) {});
  ImageBands view = making.sheet.view->paint(std::move(kept));
  const auto stored = [&](Layers rows) {
    return stored_picture(making.plan, making.task, std::move(rows), Shown::View, making.config);
  };
  view.names = names_of(stored(make_layers({1, 1}, view.names)));
  view.make = [&, paint = std::move(view.make)](int first, int rows) {
    heed();
    return stored(paint(first, rows));
  };
  const std::string& name = making.task.out;
  const WriteOptions options = write_options(making.plan, making.task, making.sheet.files.front());
  Written written;
  note_clamping(name, options.type, write_bands(making.plan.output / name, view, options), written);
  return written;
}

}  // namespace

Written write_sheet(const Plan& plan, const Task& task, const MapSheet& sheet, SetReader& reader,
                    const ColorConfig& config, const std::function<void()>& heed) {
  const BandPlan bands = require_bands(cost_of_rows(plan, task), plan.max_memory);
  const Making making{plan, task, sheet, config};
  const bool is_picture = task.product == Product::Picture;
  const bool late = is_picture && shown_by(task, sheet.view.has_value()) == Shown::View;
  return late ? write_late_view(making, reader, bands, heed)
              : write_files(making, reader, bands, heed);
}

}  // namespace kiln
