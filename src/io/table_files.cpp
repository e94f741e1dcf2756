// SPDX-License-Identifier: Apache-2.0
#include "table_files.h"

#include <fmt/format.h>

#include <algorithm>

#include "kiln/core/error.h"
#include "samples.h"
#include "texel_pack.h"

namespace kiln::io {
namespace {

bool is_texture(std::string_view format) { return format == "dds" || format == "ktx2"; }

// Three channels of less than a float's width are no format of DXGI; they get an alpha.
int stored_channels(std::string_view format, PixelType type, size_t planes) {
  const auto count = static_cast<int>(planes);
  if (!is_texture(format)) return count;
  if (type == PixelType::Rgb10a2) return 4;
  return count == 3 && type != PixelType::Float ? 4 : count;
}

[[noreturn]] void refuse(const std::string& what) { throw Error(Fault::Internal, what); }

void check_labels(const Contents& contents, const StoredPlanes& stored, const Labels& labels) {
  if (!labels.channels.empty() && labels.channels.size() != stored.planes.size()) {
    refuse(fmt::format("{} names for {} channels", labels.channels.size(), stored.planes.size()));
  }
  if (labels.axes.empty()) return;
  const int lengths[] = {contents.slice.width, contents.slice.height, contents.depth};
  const size_t least = contents.depth > 1 ? 3 : contents.slice.height > 1 ? 2 : 1;
  bool fits = labels.axes.size() >= least && labels.axes.size() <= std::max<size_t>(least, 2);
  for (size_t axis = 0; fits && axis < labels.axes.size(); ++axis) {
    fits = labels.axes[axis].coordinates.size() == static_cast<size_t>(lengths[axis]);
  }
  if (!fits) refuse("the labels' axes are not those of the image");
}

Contents contents_of(const FileToWrite& file, const StoredPlanes& layout) {
  const int depth = file.options.depth;
  if (depth < 1 || file.size.height % depth != 0) {
    refuse(fmt::format("{} rows are no {} slices", file.size.height, depth));
  }
  return {.slice = {file.size.width, file.size.height / depth},
          .depth = depth,
          .channels = stored_channels(file.format, file.options.type, layout.planes.size())};
}

size_t texel_bytes(int channels, PixelType type) {
  return type == PixelType::Rgb10a2 ? sample_bytes(type)
                                    : static_cast<size_t>(channels) * sample_bytes(type);
}

std::string header_of(const FileToWrite& file, const Contents& contents) {
  const PixelType type = file.options.type;
  if (file.format == "npy") return npy_header(contents, type);
  const size_t bytes = static_cast<size_t>(area(file.size)) * texel_bytes(contents.channels, type);
  if (file.format == "dds") return dds_header(contents, type, bytes);
  return ktx2_header(contents, type, file.options.attributes, bytes);
}

// A header, then nothing but texels.
class TexelEncoder : public BandEncoder {
 public:
  TexelEncoder(const FileToWrite& file, const Contents& contents)
      : file_(file), channels_(contents.channels) {
    file_.out.append(header_of(file, contents));
  }

  void add(const StoredPlanes& band) override {
    file_.out.append(packed_texels(band.size(), band, channels_, file_.options.type, file_.facts));
  }

  void finish() override {}

 private:
  FileToWrite file_;
  int channels_;
};

}  // namespace

std::unique_ptr<BandEncoder> table_encoder(const FileToWrite& file, const StoredPlanes& layout) {
  const Contents contents = contents_of(file, layout);
  check_labels(contents, layout, file.options.labels);
  if (file.format == "csv") return csv_encoder(file, contents, layout);
  if (file.format == "h") return c_header_encoder(file, contents, layout);
  return std::make_unique<TexelEncoder>(file, contents);
}

}  // namespace kiln::io
