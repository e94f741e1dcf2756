// SPDX-License-Identifier: Apache-2.0
#include "axes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace kiln::validate {
namespace {

double place(const Placement& alignment, bool reversed, int n, int entry) {
  const int i = reversed ? n - 1 - entry : entry;
  const double last = alignment.nodes ? std::max(n - 1, 1) : n;
  return std::clamp((i + alignment.offset) / last, 0.0, 1.0);
}

double cosine_at(CosineAxis map, double u) {
  switch (map) {
    case CosineAxis::SquareRoot:
      return u * u;
    case CosineAxis::CubeRoot:
      return u * u * u;
    case CosineAxis::OneMinusRoot:
      return 1 - (1 - u) * (1 - u);
    default:
      return u;
  }
}

double alpha_at(WidthAxis map, double u) {
  switch (map) {
    case WidthAxis::Alpha:
      return u;
    case WidthAxis::FourthRoot:
      return u * u * u * u;
    default:
      return u * u;
  }
}

}  // namespace

std::vector<double> positions(const AxisReading<CosineAxis>& axis, int n,
                              const std::vector<int>& entries) {
  std::vector<double> found;
  found.reserve(entries.size());
  for (const int i : entries) {
    found.push_back(cosine_at(axis.map, place(axis.alignment, axis.reversed, n, i)));
  }
  return found;
}

std::vector<double> positions(const AxisReading<WidthAxis>& axis, int n,
                              const std::vector<int>& entries) {
  std::vector<double> found;
  found.reserve(entries.size());
  for (const int i : entries) {
    found.push_back(alpha_at(axis.map, place(axis.alignment, axis.reversed, n, i)));
  }
  return found;
}

AxisReading<CosineAxis> cosine_axis(const TableAxes& axes) {
  return {axes.cosine, axes.cosine_reversed, axes.cosine_alignment};
}

AxisReading<WidthAxis> width_axis(const TableAxes& axes) {
  return {axes.width, axes.width_reversed, axes.width_alignment};
}

std::vector<TableAxes> all_axes() {
  std::vector<TableAxes> all;
  for (const bool transposed : {false, true}) {
    for (const bool cosine_reversed : {false, true}) {
      for (const bool width_reversed : {false, true}) {
        for (const auto cosine : {CosineAxis::Cosine, CosineAxis::SquareRoot, CosineAxis::CubeRoot,
                                  CosineAxis::OneMinusRoot}) {
          for (const auto width : {WidthAxis::Roughness, WidthAxis::Alpha, WidthAxis::FourthRoot}) {
            all.push_back({transposed, cosine, width, cosine_reversed, width_reversed, {}, {}});
          }
        }
      }
    }
  }
  return all;
}

const std::vector<Placement>& all_alignments() {
  static const std::vector<Placement> all{centres,      nodes,         {0.0, false}, {1.0, false},
                                          {1.5, false}, {-0.5, false}, {1.0, true},  {-1.0, true}};
  return all;
}

std::string words(const AxisReading<CosineAxis>& axis) {
  switch (axis.map) {
    case CosineAxis::SquareRoot:
      return axis.reversed ? "1 - sqrt(n.v)" : "sqrt(n.v)";
    case CosineAxis::CubeRoot:
      return axis.reversed ? "1 - cbrt(n.v)" : "cbrt(n.v)";
    case CosineAxis::OneMinusRoot:
      return axis.reversed ? "sqrt(1 - n.v)" : "1 - sqrt(1 - n.v)";
    default:
      return axis.reversed ? "1 - n.v" : "n.v";
  }
}

std::string words(const AxisReading<WidthAxis>& axis) {
  switch (axis.map) {
    case WidthAxis::Alpha:
      return axis.reversed ? "1 - alpha" : "alpha";
    case WidthAxis::FourthRoot:
      return axis.reversed ? "1 - roughness (alpha = roughness^4)"
                           : "roughness (alpha = roughness^4)";
    default:
      return axis.reversed ? "1 - roughness (alpha = roughness^2)"
                           : "roughness (alpha = roughness^2)";
  }
}

std::string words(const Placement& alignment) {
  if (alignment == centres) return "centres (i + 1/2) / N";
  if (alignment == nodes) return "nodes i / (N - 1)";
  const std::string i = alignment.offset == 0  ? "i"
                        : alignment.offset < 0 ? fmt::format("(i - {:g})", -alignment.offset)
                                               : fmt::format("(i + {:g})", alignment.offset);
  return alignment.nodes ? i + " / (N - 1), clamped" : i + " / N, clamped";
}

std::string words(const TableAxes& axes) {
  const std::string cosine = words(cosine_axis(axes)), width = words(width_axis(axes));
  std::string text = axes.transposed ? fmt::format("x = {}, y = {}", width, cosine)
                                     : fmt::format("x = {}, y = {}", cosine, width);
  if (axes.cosine_alignment == axes.width_alignment) {
    return text + "; entries at " + words(axes.cosine_alignment);
  }
  return text + fmt::format("; n.v at {}, widths at {}", words(axes.cosine_alignment),
                            words(axes.width_alignment));
}

}  // namespace kiln::validate
