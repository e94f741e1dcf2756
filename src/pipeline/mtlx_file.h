// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <pugixml.hpp>
#include <string>

#include "kiln/image/wrap.h"

namespace kiln {

/// What an input of a MaterialX shader comes to: a constant, or channels of an image.
struct MtlxSource {
  std::array<float, 3> value = {0, 0, 0};
  std::filesystem::path path;  ///< of an image; empty: a constant
  std::string channels;        ///< of the image: "rgb", "rg", "r", "g", "b" or "a"
  std::string color_space;     ///< as stated, in kiln's words; empty: nothing is stated
  float normal_scale = 1;      ///< of a normal map
  std::optional<Wrap> wrap;    ///< of an image
};

/// A MaterialX document.
class MtlxFile {
 public:
  /// @error Fault::Input, "FILE:LINE: what is wrong"
  explicit MtlxFile(const std::filesystem::path& path);

  pugi::xml_node root() const { return document_.document_element(); }

  /// Follows an input through outputs, node graphs, normal maps and picks of channels to its
  /// constant or image.
  /// @error Fault::Input naming whatever else stands between, and what is missing
  MtlxSource source_of(pugi::xml_node input) const;

  /// The element that an input names, in its own graph or the document.
  pugi::xml_node node_of(pugi::xml_node input) const;

  /// The input of that name, or an empty one.
  static pugi::xml_node input_of(pugi::xml_node node, const std::string& name);

  [[noreturn]] void refuse(pugi::xml_node at, const std::string& message) const;

 private:
  struct Walk {
    std::string feeds;  ///< name of the input where it began
    int depth = 0;
  };
  MtlxSource follow(pugi::xml_node from, Walk walk) const;
  MtlxSource of_graph(pugi::xml_node graph, pugi::xml_node from, Walk walk) const;
  MtlxSource of_node(pugi::xml_node node, const std::string& output, Walk walk) const;
  MtlxSource of_image(pugi::xml_node node, const std::string& output) const;
  MtlxSource of_constant(pugi::xml_node at) const;
  MtlxSource picked(MtlxSource source, const std::string& channels, pugi::xml_node at) const;
  std::string color_space_of(pugi::xml_node at) const;

  std::filesystem::path path_;
  std::string text_;
  pugi::xml_document document_;
};

}  // namespace kiln
