// SPDX-License-Identifier: Apache-2.0
#include "preview_contact.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "kiln/image/resample.h"
#include "lettering.h"
#include "preview_difference.h"
#include "sheet.h"

namespace kiln {
namespace {

using Settings = PreviewBake::Settings;
using Mode = PreviewBake::Mode;

constexpr std::array<double, 3> rotations = {0, 120, 240};  // of the environment [degree]
const Vec3<float> paper{0.016f, 0.016f, 0.017f}, ink{0.75f, 0.75f, 0.73f},
    pale_ink{0.3f, 0.3f, 0.3f};

// Where things lie, in texels.
struct Layout {
  Size cell;
  int margin, gap, title, caption, thumbnail, width, height;

  int column(int i) const { return margin + i * (cell.width + gap); }
  int row(int i) const { return title + i * (cell.height + caption); }
  int maps_row() const { return row(2) + gap; }
};

Layout layout_of(Size cell, int thumbnails) {
  const double unit = std::min(cell.width, cell.height) / 448.0;
  const auto texels = [&](double n) {
    return std::max(1, static_cast<int>(std::lround(n * unit)));
  };
  Layout at{cell, texels(36), texels(20), texels(128), texels(44), 0, 0, 0};
  at.width = 2 * at.margin + 3 * cell.width + 2 * at.gap;
  const int inside = at.width - 2 * at.margin;
  at.thumbnail = std::max(1, (inside - (thumbnails - 1) * at.gap) / thumbnails);
  at.height = at.maps_row() + at.thumbnail + at.caption + at.margin / 2;
  return at;
}

// The size of one picture on the sheet.
Size cell_of(const Settings& settings) {
  constexpr Size usual{448, 448};
  return settings.size.width > 0 ? settings.size : usual;
}

// The largest size of the same shape inside a cell.
Size fitted(Size map, Size cell) {
  const double scale = std::min(static_cast<double>(cell.width) / map.width,
                                static_cast<double>(cell.height) / map.height);
  const auto side = [&](int n) { return std::max(1, static_cast<int>(std::lround(n * scale))); };
  return {side(map.width), side(map.height)};
}

// A map as the sheet shows it.
struct Thumbnail {
  std::string caption;
  std::array<const Plane*, 3> planes;
  enum class Shown { Light, Number, Direction } shown;
};

std::string range_text(const Plane& plane) {
  float least = 1e30f, greatest = -1e30f;
  for (int y = 0; y < plane.height(); ++y) {
    for (const float value : plane.texels_of_row(y)) {
      least = std::min(least, value);
      greatest = std::max(greatest, value);
    }
  }
  return greatest - least < 1e-3f ? fmt::format("{:.2g}", least)
                                  : fmt::format("{:.2g} to {:.2g}", least, greatest);
}

std::vector<Thumbnail> thumbnails_of(const Svbrdf& s) {
  using Shown = Thumbnail::Shown;
  const auto one = [](const Plane& p) { return std::array<const Plane*, 3>{&p, &p, &p}; };
  const auto three = [](const std::array<Plane, 3>& p) {
    return std::array<const Plane*, 3>{&p[0], &p[1], &p[2]};
  };
  std::vector<Thumbnail> all = {
      {"diffuse colour", three(s.diffuse_color), Shown::Light},
      {"F0", three(s.f0), Shown::Light},
      {"roughness " + range_text(s.roughness), one(s.roughness), Shown::Number},
      {"normal, +Y up", three(s.normal), Shown::Direction},
      {"occlusion " + range_text(s.ambient_occlusion), one(s.ambient_occlusion), Shown::Number}};
  if (!s.anisotropy.empty()) {
    all.push_back({"anisotropy " + range_text(s.anisotropy), one(s.anisotropy), Shown::Number});
  }
  return all;
}

Layers painted(const Thumbnail& thumbnail, int edge) {
  const Size size = fitted(thumbnail.planes[0]->size(), {edge, edge});
  Layers picture = make_layers(size, {"R", "G", "B", "A"});
  for (size_t c = 0; c < 3; ++c) {
    Plane& plane = picture.layers[c].plane;
    plane = resample(*thumbnail.planes[c], size);
    if (thumbnail.shown == Thumbnail::Shown::Light) continue;
    const bool direction = thumbnail.shown == Thumbnail::Shown::Direction;
    for (int y = 0; y < size.height; ++y) {
      for (int x = 0; x < size.width; ++x) {
        const float value = plane.at(x, y);
        plane.at(x, y) = from_srgb(direction ? 0.5f * value + 0.5f : value);
      }
    }
  }
  picture.layers[3].plane = Plane(size, 1.0f);
  return picture;
}

struct Tile {
  Rendered picture;
  std::string caption;
};

// Balls, then planes.
std::vector<Tile> render_tiles(const Svbrdf& maps, const ShadingInputs& inputs,
                               const Settings& settings, const Layout& at, Vec3<double> to_viewer) {
  std::vector<Tile> tiles;
  for (const bool ball : {true, false}) {
    for (const double turn : rotations) {
      const Size size = ball ? at.cell : fitted(maps.size, at.cell);
      const Picture picture(maps, {ball, size, to_viewer, settings.rotate + turn});
      std::string where = inputs.light
                              ? fmt::format(", environment at {:g} degrees", settings.rotate + turn)
                              : std::string();
      tiles.push_back({render_preview(picture, inputs, settings),
                       (ball ? "sphere" : "flat") + std::move(where)});
    }
  }
  return tiles;
}

void write_caption(const std::string& text, Corner at, int width, const Layout& layout,
                   Layers& sheet) {
  const double height = 0.27 * layout.caption;
  draw_text(sheet, {at.x + 0.2 * height, at.y + 0.6 * layout.caption},
            text_within(text, height, width), {height, ink});
}

// On the left of its cell, above its caption.
void place_tile(const Layers& picture, const std::string& caption, int index, const Layout& layout,
                Layers& sheet) {
  const Corner corner{layout.column(index % 3), layout.row(index / 3)};
  const Size cell = layout.cell;
  place(picture, {corner.x, corner.y + cell.height - picture.size.height}, sheet);
  write_caption(caption, {corner.x, corner.y + cell.height}, cell.width, layout, sheet);
}

void place_maps(const std::vector<Thumbnail>& thumbnails, const Layout& layout, Layers& sheet) {
  for (size_t i = 0; i < thumbnails.size(); ++i) {
    const Layers picture = painted(thumbnails[i], layout.thumbnail);
    const int x = layout.margin + static_cast<int>(i) * (layout.thumbnail + layout.gap);
    const Corner corner{x, layout.maps_row()};
    place(picture, {corner.x, corner.y + layout.thumbnail - picture.size.height}, sheet);
    write_caption(thumbnails[i].caption, {corner.x, corner.y + layout.thumbnail}, layout.thumbnail,
                  layout, sheet);
  }
}

std::string conditions(const ShadingInputs& inputs, const Settings& settings,
                       const PictureFacts& whole) {
  std::string text;
  if (settings.mode != Mode::Reference) {
    text = settings.mode == Mode::SplitSum ? "split-sum" : "split-sum minus reference";
  } else {
    text = "reference";
  }
  if (whole.mean_samples > 0) {
    text += fmt::format(", {:.0f} samples, standard error {:.2g}", whole.mean_samples,
                        whole.mean_error);
  }
  if (!inputs.lights.empty()) {
    text += fmt::format(", {} directional light{}", inputs.lights.size(),
                        inputs.lights.size() == 1 ? "" : "s");
  }
  return text;
}

void write_title(const std::string& name, const ShadingInputs& inputs, const Settings& settings,
                 const PictureFacts& whole, const Layout& layout, Layers& sheet) {
  const double unit = layout.title / 128.0, left = layout.margin;
  const double width = layout.width - 2 * left;
  draw_text(sheet, {left, 58 * unit}, text_within(name, 26 * unit, width), {26 * unit, ink});
  draw_text(sheet, {left, 86 * unit},
            text_within(conditions(inputs, settings, whole), 12 * unit, width), {12 * unit, ink});
  draw_text(sheet, {left, 108 * unit}, text_within(surface_words(inputs.surface), 10 * unit, width),
            {10 * unit, pale_ink});
}

Layers scene_linear(Layers codes) {
  for (size_t c = 0; c < 3; ++c) {
    for (int y = 0; y < codes.size.height; ++y) {
      float* row = codes.layers[c].plane.row(y);
      std::transform(row, row + codes.size.width, row, from_srgb);
    }
  }
  return codes;
}

Layers display_codes(Layers linear) {
  for (size_t c = 0; c < 3; ++c) {
    for (int y = 0; y < linear.size.height; ++y) {
      float* row = linear.layers[c].plane.row(y);
      std::transform(row, row + linear.size.width, row, to_srgb);
    }
  }
  return linear;
}

PictureFacts means_of(const std::vector<Tile>& tiles) {
  PictureFacts whole;
  const double share = 1.0 / static_cast<double>(tiles.size());
  for (const Tile& tile : tiles) {
    const PictureFacts& one = tile.picture.facts;
    whole.mean_samples += share * one.mean_samples;
    whole.most_samples = std::max(whole.most_samples, one.most_samples);
    whole.mean_error += share * one.mean_error;
    whole.above_target += share * one.above_target;
    whole.mean_radiance += share * one.mean_radiance;
    whole.lost += share * one.lost;
    whole.trapped += share * one.trapped;
  }
  return whole;
}

// The sheet without its pictures.
Layers blank_sheet(const Svbrdf& maps, const ShadingInputs& inputs, const Settings& settings,
                   const PictureFacts& whole, const Layout& layout) {
  Layers sheet = make_sheet({layout.width, layout.height}, paper);
  write_title(maps.name, inputs, settings, whole, layout, sheet);
  place_maps(thumbnails_of(maps), layout, sheet);
  return sheet;
}

// One scale for all pictures, its legend beside the title.
Layers false_colour_sheet(const std::vector<Tile>& tiles, const Layout& layout, Layers sheet) {
  std::vector<const Layers*> differences;
  differences.reserve(tiles.size());
  for (const Tile& tile : tiles) differences.push_back(&tile.picture.image);
  const double scale = difference_scale(differences);
  for (size_t i = 0; i < tiles.size(); ++i) {
    place_tile(scene_linear(paint_difference(*differences[i], scale)), tiles[i].caption,
               static_cast<int>(i), layout, sheet);
  }
  const Size strip{layout.cell.width, layout.title * 48 / 128};
  place(scene_linear(difference_legend(strip, scale)), {layout.column(2), layout.title * 28 / 128},
        sheet);
  return display_codes(std::move(sheet));
}

}  // namespace

Size texels_of_contact_sheet(const Settings& settings) {
  constexpr int least = 2048;  // of maps whose ranges are told
  const Size cell = cell_of(settings), ball = Picture::texels_read(true, cell),
             plane = Picture::texels_read(false, cell);
  return {std::max({least, ball.width, plane.width}), std::max({least, ball.height, plane.height})};
}

ContactSheet make_contact_sheet(const Svbrdf& maps, const ShadingInputs& inputs,
                                const Settings& settings, Vec3<double> to_viewer) {
  const Layout layout = layout_of(cell_of(settings), static_cast<int>(thumbnails_of(maps).size()));
  const std::vector<Tile> tiles = render_tiles(maps, inputs, settings, layout, to_viewer);
  ContactSheet made{{{}, means_of(tiles)}, {}};
  Layers sheet = blank_sheet(maps, inputs, settings, made.whole.facts, layout);
  if (settings.mode == Mode::Difference) made.view = false_colour_sheet(tiles, layout, sheet);
  for (size_t i = 0; i < tiles.size(); ++i) {
    place_tile(tiles[i].picture.image, tiles[i].caption, static_cast<int>(i), layout, sheet);
  }
  made.whole.image = std::move(sheet);
  return made;
}

}  // namespace kiln
