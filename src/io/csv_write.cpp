// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <iterator>

#include "attribute_lines.h"
#include "kiln/core/error.h"
#include "table_files.h"

namespace kiln::io {
namespace {

// Names are quoted where they would break the line into other columns.
std::string cell(const std::string& name) {
  if (name.find_first_of(",\"\n\r;\t#") == std::string::npos) return name;
  std::string quoted = "\"";
  for (const char c : name) {
    if (c == '"') quoted += '"';
    quoted += c == '\n' || c == '\r' ? ' ' : c;
  }
  return quoted += '"';
}

struct AxisTexts {
  std::string name;
  std::vector<std::string> coordinates;
};

AxisTexts axis_texts(const WriteOptions& options, size_t axis, int length) {
  constexpr const char* indices[] = {"x", "y", "z"};
  AxisTexts texts{indices[axis], {}};
  texts.coordinates.reserve(static_cast<size_t>(length));
  if (options.labels.axes.empty()) {
    for (int i = 0; i < length; ++i) texts.coordinates.push_back(fmt::format("{},", i));
    return texts;
  }
  const Labels::Axis& stated = options.labels.axes[axis];
  texts.name = stated.name;
  for (const double one : stated.coordinates) {
    texts.coordinates.push_back(fmt::format("{:.9g},", one));
  }
  return texts;
}

std::vector<AxisTexts> all_axes(const Contents& contents, const WriteOptions& options) {
  std::vector<int> lengths{contents.slice.width, contents.slice.height};
  if (contents.depth > 1) lengths.push_back(contents.depth);
  if (!options.labels.axes.empty()) lengths.resize(options.labels.axes.size());  // curves have one
  std::vector<AxisTexts> axes;
  for (size_t axis = 0; axis < lengths.size(); ++axis) {
    axes.push_back(axis_texts(options, axis, lengths[axis]));
  }
  return axes;
}

std::string head(const std::vector<AxisTexts>& axes, const StoredPlanes& stored,
                 const Attributes& attributes) {
  std::string text;
  for (const auto& [name, value] : attributes) text += comment_line("# ", name, value);
  for (const AxisTexts& axis : axes) text.append(cell(axis.name)).append(",");
  for (const std::string& name : stored.names) text.append(cell(name)).append(",");
  text.back() = '\n';
  return text;
}

class CsvEncoder : public BandEncoder {
 public:
  CsvEncoder(const FileToWrite& file, const Contents& contents, const StoredPlanes& layout)
      : file_(file), contents_(contents), axes_(all_axes(contents, file.options)) {
    file_.out.append(head(axes_, layout, file.options.attributes));
  }

  void add(const StoredPlanes& band) override {
    for (int y = 0; y < band.size().height; ++y, ++written_) {
      text_.clear();
      for (int x = 0; x < contents_.slice.width; ++x) append_entry(band, x, y);
      file_.out.append(text_);
    }
  }

  void finish() override {}

 private:
  void append_entry(const StoredPlanes& band, int x, int y) {
    const int height = contents_.slice.height;
    text_ += axes_[0].coordinates[static_cast<size_t>(x)];
    if (axes_.size() > 1) text_ += axes_[1].coordinates[static_cast<size_t>(written_ % height)];
    if (axes_.size() > 2) text_ += axes_[2].coordinates[static_cast<size_t>(written_ / height)];
    for (const Plane* plane : band.planes) {
      fmt::format_to(std::back_inserter(text_), "{:.9g},", plane->at(x, y));
    }
    text_.back() = '\n';
  }

  FileToWrite file_;
  Contents contents_;
  std::vector<AxisTexts> axes_;
  std::string text_;
  int written_ = 0;
};

}  // namespace

std::unique_ptr<BandEncoder> csv_encoder(const FileToWrite& file, const Contents& contents,
                                         const StoredPlanes& layout) {
  return std::make_unique<CsvEncoder>(file, contents, layout);
}

}  // namespace kiln::io
