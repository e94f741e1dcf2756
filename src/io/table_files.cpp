// SPDX-License-Identifier: Apache-2.0
#include "table_files.h"

#include <fmt/format.h>

#include <algorithm>

#include "kiln/core/error.h"
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

}  // namespace

std::string encode_table(std::string_view format, const std::filesystem::path& path,
                         const StoredPlanes& planes, const WriteOptions& options,
                         WriteFacts& facts) {
  const Size size = planes.planes.front()->size();
  if (options.depth < 1 || size.height % options.depth != 0) {
    refuse(fmt::format("{} rows are no {} slices", size.height, options.depth));
  }
  if (options.type == PixelType::Rgbd8) {
    const Layers coded = rgbd_image(size, planes, facts);
    WriteOptions as_bytes = options;
    as_bytes.type = PixelType::Uint8;
    as_bytes.labels = {};
    return encode_table(format, path, planes_of(coded), as_bytes, facts);
  }
  const Contents contents{.slice = {size.width, size.height / options.depth},
                          .depth = options.depth,
                          .channels = stored_channels(format, options.type, planes.planes.size())};
  check_labels(contents, planes, options.labels);
  if (format == "csv") return encode_csv(contents, planes, options);
  const std::string texels = packed_texels(size, planes, contents.channels, options.type, facts);
  if (format == "dds") return encode_dds(contents, options.type, texels);
  if (format == "ktx2") return encode_ktx2(contents, options.type, options.attributes, texels);
  if (format == "npy") return encode_npy(contents, options.type, texels);
  return encode_c_header(path, contents, planes, options, texels);
}

}  // namespace kiln::io
