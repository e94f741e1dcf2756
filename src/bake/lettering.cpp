// SPDX-License-Identifier: Apache-2.0
#include "lettering.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace kiln {
namespace {

constexpr double capital = 6;      // units from baseline to top
constexpr double gap = 2;          // units between letters
constexpr double space_width = 2;  // units
constexpr double half_stroke = 0.42;

struct Segment {
  Vec2<double> a, b;
};

Vec2<double> point_at(std::string_view strokes, size_t i) {
  return {static_cast<double>(strokes[i] - '0'), static_cast<double>(strokes[i + 1] - '0')};
}

// A stroke of one point, given twice, is a dot.
std::vector<Segment> segments_of(char letter) {
  const std::string_view strokes = strokes_of(letter);
  std::vector<Segment> segments;
  for (size_t i = 0; i + 3 < strokes.size(); i += 2) {
    if (strokes[i + 2] == ' ') {
      ++i;
      continue;
    }
    segments.push_back({point_at(strokes, i), point_at(strokes, i + 2)});
  }
  return segments;
}

double width_of(const std::vector<Segment>& segments) {
  double width = segments.empty() ? space_width : 0;
  for (const Segment& s : segments) width = std::max({width, s.a.x, s.b.x});
  return width;
}

// Of a letter beyond ASCII the first byte counts.
bool continues_letter(char byte) { return (static_cast<unsigned char>(byte) & 0xc0) == 0x80; }

double distance_to(const Segment& s, double x, double y) {
  const double dx = s.b.x - s.a.x, dy = s.b.y - s.a.y;
  const double squared = dx * dx + dy * dy;
  const double along = squared > 0 ? ((x - s.a.x) * dx + (y - s.a.y) * dy) / squared : 0;
  const double t = std::clamp(along, 0.0, 1.0);
  return std::hypot(x - s.a.x - t * dx, y - s.a.y - t * dy);
}

// What of a texel the strokes cover.
double coverage(const std::vector<Segment>& segments, double x, double y, double unit) {
  double nearest = 1e9;
  for (const Segment& s : segments) nearest = std::min(nearest, distance_to(s, x, y));
  const double radius = std::max(half_stroke * unit, 0.55);
  return std::clamp(radius - nearest * unit + 0.5, 0.0, 1.0);
}

void draw_letter(Layers& image, Vec2<double> origin, const std::vector<Segment>& segments,
                 double unit, const Vec3<float>& ink) {
  const float color[3] = {ink.x, ink.y, ink.z};
  const int x0 = std::max(static_cast<int>(origin.x - unit - 1), 0);
  const int x1 =
      std::min(static_cast<int>(origin.x + (width_of(segments) + 1) * unit + 2), image.size.width);
  const int y0 = std::max(static_cast<int>(origin.y - unit - 1), 0);
  const int y1 = std::min(static_cast<int>(origin.y + 9 * unit + 2), image.size.height);
  for (int y = y0; y < y1; ++y) {
    for (int x = x0; x < x1; ++x) {
      const double share =
          coverage(segments, (x + 0.5 - origin.x) / unit, (y + 0.5 - origin.y) / unit, unit);
      if (share <= 0) continue;
      for (size_t c = 0; c < 3; ++c) {
        float& texel = image.layers[c].plane.at(x, y);
        texel = std::lerp(texel, color[c], static_cast<float>(share));
      }
    }
  }
}

}  // namespace

double text_width(std::string_view text, double height) {
  double units = 0;
  for (const char letter : text) {
    if (!continues_letter(letter)) units += width_of(segments_of(letter)) + gap;
  }
  return std::max(units - gap, 0.0) * height / capital;
}

std::string text_within(std::string_view text, double height, double width) {
  std::string kept(text);
  if (text_width(kept, height) <= width) return kept;
  while (!kept.empty() && text_width(kept + "...", height) > width) kept.pop_back();
  return kept.empty() ? kept : kept + "...";
}

void draw_text(Layers& image, Vec2<double> left_baseline, std::string_view text,
               const Lettering& lettering) {
  const double unit = lettering.height / capital;
  Vec2<double> origin{left_baseline.x, left_baseline.y - lettering.height};
  for (const char letter : text) {
    if (continues_letter(letter)) continue;
    const std::vector<Segment> segments = segments_of(letter);
    draw_letter(image, origin, segments, unit, lettering.ink);
    origin.x += (width_of(segments) + gap) * unit;
  }
}

}  // namespace kiln
