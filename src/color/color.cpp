// SPDX-License-Identifier: Apache-2.0
#include "kiln/color/color.h"

#include <OpenColorIO/OpenColorIO.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <sstream>
#include <utility>

#include "kiln/core/error.h"
#include "kiln/core/names.h"
#include "kiln/parallel/rows.h"

namespace kiln {
namespace {

namespace OCIO = OCIO_NAMESPACE;

// What the library would print is said by errors instead.
void silence_library() {
  static const bool silent = [] {
    OCIO::SetLoggingLevel(OCIO::LOGGING_LEVEL_NONE);
    OCIO::SetLoggingFunction([](const char*) {});
    return true;
  }();
  static_cast<void>(silent);
}

// Everything that the library throws becomes an error of the config.
template <class Work>
auto translated(const std::string& source, Work&& work) {
  try {
    return work();
  } catch (const Error&) {
    throw;
  } catch (const std::exception& error) {
    std::string reason = error.what();
    std::replace(reason.begin(), reason.end(), '\n', ' ');
    throw Error(Fault::Input, fmt::format("colour config '{}': {}", source, reason));
  }
}

OCIO::ConstConfigRcPtr load(const std::string& source) {
  silence_library();
  return translated(source, [&] {
    if (source == "builtin") {
      std::istringstream text{std::string(builtin_color_config())};
      return OCIO::Config::CreateFromStream(text);
    }
    if (!std::filesystem::exists(source)) throw Error(Fault::Input, source + ": no such file");
    if (std::filesystem::is_directory(source)) {
      throw Error(Fault::Input, source + ": is a folder, expected an OCIO config");
    }
    try {
      return OCIO::Config::CreateFromFile(source.c_str());
    } catch (const OCIO::Exception& error) {
      throw Error(Fault::Input,
                  fmt::format("colour config '{}' cannot be read by OpenColorIO {}: {}", source,
                              OCIO::GetVersion(), error.what()));
    }
  });
}

// The planes that carry colour: three, or one that stands for all.
using Color = std::array<Plane*, 3>;

Color color_planes(Layers& image) {
  const auto plane = [&](const char* name) -> Plane* {
    for (Layer& layer : image.layers) {
      if (layer.name == name) return &layer.plane;
    }
    return nullptr;
  };
  const Color color{plane("R"), plane("G"), plane("B")};
  if (color[0] != nullptr && color[1] != nullptr && color[2] != nullptr) return color;
  if (Plane* grey = plane("Y")) return {grey, grey, grey};
  throw Error(Fault::Usage, "the image has no colour: expected channels R, G, B or Y");
}

// A copy of R, G, B, or else of Y, and of A.
Layers color_and_alpha(const Layers& image) {
  const bool rgb = image.find("R") != nullptr && image.find("G") && image.find("B");
  const std::vector<std::string> wanted =
      rgb ? std::vector<std::string>{"R", "G", "B", "A"} : std::vector<std::string>{"Y", "A"};
  Layers result{image.size, {}};
  for (const std::string& name : wanted) {
    if (const Plane* plane = image.find(name)) result.layers.push_back({name, *plane});
  }
  return result;
}

// One row through the transform, texels side by side.
class Row {
 public:
  explicit Row(int width) : texels_(static_cast<size_t>(width) * 3) {}

  template <class Change>
  void load(const Color& color, int y, Change change) {
    for (size_t c = 0; c < 3; ++c) {
      const float* row = color[c]->row(y);
      for (size_t x = c, i = 0; x < texels_.size(); x += 3, ++i) texels_[x] = change(row[i]);
    }
  }
  void apply(const OCIO::CPUProcessor& transform) {
    OCIO::PackedImageDesc row(texels_.data(), static_cast<long>(texels_.size() / 3), 1, 3);
    transform.apply(row);
  }
  // Grey is stored as its green, which is the mean of equal values bar rounding.
  template <class Change>
  void store(const Color& color, int y, Change change) const {
    for (size_t c = 0; c < 3; ++c) {
      const size_t from = color[0] == color[1] ? 1 : c;
      float* row = color[c]->row(y);
      for (size_t x = from, i = 0; x < texels_.size(); x += 3, ++i) row[i] = change(texels_[x]);
    }
  }

 private:
  std::vector<float> texels_;
};

OCIO::ConstCPUProcessorRcPtr exact(const OCIO::ConstProcessorRcPtr& transform) {
  return transform->getOptimizedCPUProcessor(OCIO::OPTIMIZATION_LOSSLESS);
}

template <class Before, class After>
void transform_rows(const std::string& source, const OCIO::CPUProcessor& transform,
                    const Color& color, Before before, After after) {
  for_rows(color[0]->height(), [&](int y) {
    Row row(color[0]->width());
    row.load(color, y, before);
    translated(source, [&] { row.apply(transform); });
    row.store(color, y, after);
  });
}

// The library counts its names and gives them one by one.
template <class NameAt>
std::vector<std::string> listed(int count, NameAt name_at) {
  std::vector<std::string> names;
  names.reserve(static_cast<size_t>(count));
  for (int i = 0; i < count; ++i) names.emplace_back(name_at(i));
  return names;
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

struct ColorConfig::Work {
  std::string source;
  OCIO::ConstConfigRcPtr config;

  OCIO::ConstColorSpaceRcPtr find(const std::string& space) const {
    return translated(source, [&] { return config->getColorSpace(space.c_str()); });
  }

  // Names, aliases and roles: what a user may have meant.
  std::vector<std::string> all_names(const std::vector<std::string>& spaces) const {
    std::vector<std::string> names = spaces;
    for (const std::string& space : spaces) {
      const auto found = config->getColorSpace(space.c_str());
      for (size_t i = 0; i < found->getNumAliases(); ++i) names.emplace_back(found->getAlias(i));
    }
    for (int i = 0; i < config->getNumRoles(); ++i) names.emplace_back(config->getRoleName(i));
    return names;
  }

  std::string color_space(const ColorConfig& face, const std::string& name) const {
    std::string space = face.resolve(name);
    if (find(space)->isData()) {
      throw Error(Fault::Usage, fmt::format("colour space '{}' holds data, which is no colour and "
                                            "cannot be converted",
                                            space));
    }
    return space;
  }
};

ColorConfig::ColorConfig(const std::string& source)
    : work_(std::make_unique<Work>(Work{source, load(source)})) {}
ColorConfig::~ColorConfig() = default;
ColorConfig::ColorConfig(ColorConfig&&) noexcept = default;
ColorConfig& ColorConfig::operator=(ColorConfig&&) noexcept = default;

const std::string& ColorConfig::source() const { return work_->source; }

std::vector<std::string> ColorConfig::color_spaces() const {
  const OCIO::Config& config = *work_->config;
  return listed(config.getNumColorSpaces(),
                [&](int i) { return config.getColorSpaceNameByIndex(i); });
}

std::vector<std::string> ColorConfig::displays() const {
  const OCIO::Config& config = *work_->config;
  return listed(config.getNumDisplays(), [&](int i) { return config.getDisplay(i); });
}

std::vector<std::string> ColorConfig::views(const std::string& display) const {
  if (const auto known = displays(); !contains(known, display)) {
    throw Error(Fault::Usage, unknown_name("display", display, known));
  }
  const OCIO::Config& config = *work_->config;
  return listed(config.getNumViews(display.c_str()),
                [&](int i) { return config.getView(display.c_str(), i); });
}

std::string ColorConfig::default_display() const { return work_->config->getDefaultDisplay(); }

std::string ColorConfig::default_view(const std::string& display) const {
  const auto known = views(display);
  if (known.empty()) {
    throw Error(Fault::Input, fmt::format("colour config '{}': display '{}' has no views",
                                          work_->source, display));
  }
  return work_->config->getDefaultView(display.c_str());
}

std::string ColorConfig::resolve(const std::string& space) const {
  if (const auto found = work_->find(space)) return found->getName();
  if (kebab(space) == "linear") {
    throw Error(Fault::Usage,
                "colour space 'linear' does not say which primaries: name one, such as "
                "'lin_rec709_scene' (Rec.709) or 'lin_ap1_scene' (ACEScg); 'data' is for maps "
                "that are no colour");
  }
  const auto known = color_spaces();
  if (const auto nearest = nearest_name(space, work_->all_names(known))) {
    throw Error(Fault::Usage, unknown_name("colour space", space, {*nearest}));
  }
  throw Error(Fault::Usage, unknown_name("colour space", space, known));
}

bool ColorConfig::is_data(const std::string& space) const {
  return work_->find(resolve(space))->isData();
}

void ColorConfig::convert(Layers& image, const std::string& from, const std::string& to) const {
  const std::string source = work_->color_space(*this, from);
  const std::string target = work_->color_space(*this, to);
  const Color color = color_planes(image);
  if (source == target) return;
  const auto transform = translated(work_->source, [&] {
    return exact(work_->config->getProcessor(source.c_str(), target.c_str()));
  });
  const auto as_is = [](float value) { return value; };
  transform_rows(work_->source, *transform, color, as_is, as_is);
}

bool ColorConfig::converts_each_alone(const std::string& from, const std::string& to) const {
  const std::string source = work_->color_space(*this, from);
  const std::string target = work_->color_space(*this, to);
  if (source == target) return false;
  return translated(work_->source, [&] {
    return !exact(work_->config->getProcessor(source.c_str(), target.c_str()))
                ->hasChannelCrosstalk();
  });
}

Layers ColorConfig::to_display(const Layers& image, const std::string& working,
                               const Display& display) const {
  const std::string source = work_->color_space(*this, working);
  const std::string shown = display.display.empty() ? default_display() : display.display;
  const std::string view = display.view.empty() ? default_view(shown) : display.view;
  if (const auto known = views(shown); !contains(known, view)) {
    throw Error(Fault::Usage,
                unknown_name(fmt::format("view of display '{}'", shown), view, known));
  }
  const auto transform = translated(work_->source, [&] {
    const auto description = OCIO::DisplayViewTransform::Create();
    description->setSrc(source.c_str());
    description->setDisplay(shown.c_str());
    description->setView(view.c_str());
    return exact(work_->config->getProcessor(description));
  });
  Layers result = color_and_alpha(image);
  // Far beyond any view's white, yet finite after any matrix.
  static constexpr float brightest = 1e9f;
  const auto gain = static_cast<float>(std::exp2(display.exposure));
  transform_rows(
      work_->source, *transform, color_planes(result),
      [gain](float value) { return std::clamp(value * gain, -brightest, brightest); },
      [](float value) { return std::isnan(value) ? 0.0f : std::clamp(value, 0.0f, 1.0f); });
  return result;
}

}  // namespace kiln
