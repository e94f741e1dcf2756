// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "kiln/image/layers.h"

namespace kiln {

/// The text of the configuration that is embedded, textures/kiln.ocio.
std::string_view builtin_color_config();

/// A colour configuration: the only door to OpenColorIO. May be used from many threads at once.
class ColorConfig {
 public:
  /// @param source  "builtin" (the project's own, embedded), or the path of an OCIO config; callers
  ///                decide between --ocio, a pipeline's words and $OCIO
  /// @error Fault::Input when the config cannot be read by this OpenColorIO
  explicit ColorConfig(const std::string& source = "builtin");
  ~ColorConfig();
  ColorConfig(ColorConfig&&) noexcept;
  ColorConfig& operator=(ColorConfig&&) noexcept;

  const std::string& source() const;
  std::vector<std::string> color_spaces() const;  ///< names, in the config's order
  std::vector<std::string> displays() const;

  /// @error Fault::Usage for an unknown display, naming the nearest known one
  std::vector<std::string> views(const std::string& display) const;
  std::string default_display() const;
  std::string default_view(const std::string& display) const;  ///< @error as views()

  /// The config's own name of a space given by name, alias or role (capitals do not matter).
  /// Bare "linear" says nothing about primaries and is refused, unless the config has a space or
  /// alias of just that name.
  /// @error Fault::Usage, naming the nearest known one
  std::string resolve(const std::string& space) const;
  bool is_data(const std::string& space) const;  ///< @error as resolve()

  /// Converts the planes R, G, B of `image` in place, without approximations. Other planes are
  /// untouched; an image without them but with Y is taken as neutral. From a space to itself no
  /// bit changes. NaN stays NaN, and a matrix spreads it to the other two.
  /// @error    Fault::Usage for an unknown space, one that holds data, or an image of no colour;
  ///           Fault::Input when the config cannot make the transform
  /// @accuracy built-in config, values in [0,1]: 1e-6 for matrices and for decoding sRGB, 1e-5 for
  ///           encoding it (OpenColorIO joins the two pieces of the curve without the standard's
  ///           kink); above 1 the same, relative to the largest of the three
  void convert(Layers& image, const std::string& from, const std::string& to) const;

  /// Whether convert() changes colours, and each of R, G and B by itself alone.
  /// @error as convert()
  bool converts_each_alone(const std::string& from, const std::string& to) const;

  struct Display {
    std::string display = {};  ///< empty: the config's default
    std::string view = {};     ///< empty: the display's default
    double exposure = 0;       ///< [EV], applied in the working space: times 2^EV
  };
  /// Display-referred copy of R, G, B (or Y; A kept, all else left out) for 8 or 16 bit files,
  /// clamped to [0,1]. NaN becomes 0, an infinite value the largest the view maps to.
  /// @error as convert(); Fault::Usage for an unknown display or view
  Layers to_display(const Layers& image, const std::string& working, const Display& display) const;

 private:
  struct Work;
  std::unique_ptr<Work> work_;
};

}  // namespace kiln
