// SPDX-License-Identifier: Apache-2.0
#include "kiln/table/snippet.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "kiln/core/error.h"

namespace kiln {
namespace {

std::string function_name(const LutSource& lut) {
  std::string name = "kiln_" + lut.recipe().table;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

std::string arguments(const LutSource& lut) {
  std::string text;
  for (const TableAxis& axis : lut.axes()) {
    text += ", float " + quantity_name(axis.mapping.quantity);
  }
  return text;
}

// The position along an axis, 0 at the first entry's side.
std::string position(const TableAxis& axis) {
  const std::string& code = axis.mapping.position_code;
  return axis.flipped ? "1.0 - (" + code + ")" : code;
}

// The same in texture coordinates: entries on the borders lie half a texel inside.
std::string coordinate(const LutSource& lut, const TableAxis& axis) {
  if (lut.recipe().alignment == Alignment::Center) return position(axis);
  return fmt::format("(({}) * {}.0 + 0.5) / {}.0", position(axis), axis.count - 1, axis.count);
}

std::string described(const LutSource& lut, const std::string& file) {
  std::vector<std::string> axes, meanings;
  for (size_t a = 0; a < lut.axes().size(); ++a) {
    axes.push_back(fmt::format("{}: {}", "xyz"[a], lut.axes()[a].mapping.meaning));
  }
  for (const std::string& channel : lut.recipe().channels) {
    meanings.push_back(find_channel(channel).meaning);
  }
  const Lobe& lobe = lut.recipe().models.lobe;
  return fmt::format("// {}: {} of {} with {}.\n// {}.\n// Channels: {}.\n", file,
                     lut.recipe().table, lobe.distribution, lobe.masking, fmt::join(axes, "; "),
                     fmt::join(meanings, "; "));
}

std::vector<std::vector<double>> check_points(const LutSource& lut) {
  constexpr double positions[5][3] = {
      {0.1, 0.2, 0.3}, {0.3, 0.5, 0.6}, {0.5, 0.35, 0.45}, {0.7, 0.8, 0.15}, {0.95, 0.65, 0.85}};
  std::vector<std::vector<double>> points;
  for (const auto& row : positions) {
    std::vector<double> point;
    for (size_t a = 0; a < lut.axes().size(); ++a) {
      const double value = lut.axes()[a].mapping.value(row[a]);
      point.push_back(std::round(value * 1e4) / 1e4);
    }
    points.push_back(point);
  }
  return points;
}

std::string checks(LutSource& lut) {
  std::string text = "// Check, to the rounding of the file's type:\n";
  for (const auto& point : check_points(lut)) {
    const std::vector<double> values = look_up(lut, point);
    text += fmt::format("//   {}({}) = {:.6f}\n", function_name(lut), fmt::join(point, ", "),
                        fmt::join(values, ", "));
  }
  return text;
}

void check_sampled(const LutSource& lut) {
  if (lut.recipe().channels.size() > 4) {
    throw Error(Fault::Usage, fmt::format("snippet: found {} channels, a sampler holds 4",
                                          lut.recipe().channels.size()));
  }
}

std::string sampled_coordinates(const LutSource& lut) {
  std::vector<std::string> parts;
  for (const TableAxis& axis : lut.axes()) parts.push_back(coordinate(lut, axis));
  if (parts.size() == 1) parts.emplace_back("0.5");
  return fmt::format("{}", fmt::join(parts, ", "));
}

std::string glsl(const LutSource& lut, bool rgbd) {
  check_sampled(lut);
  const bool solid = lut.axes().size() > 2;
  const size_t n = lut.recipe().channels.size();
  const std::string type = n == 1 ? "float" : fmt::format("vec{}", n);
  const std::string swizzle = std::string("rgba").substr(0, n);
  std::string text =
      "// Linear filtering, clamped to the edge; no sRGB; the first row lies at v = 0.\n";
  text += fmt::format("{} {}({} table{}) {{\n", type, function_name(lut),
                      solid ? "sampler3D" : "sampler2D", arguments(lut));
  text += fmt::format("  vec{} at = vec{}({});\n", solid ? 3 : 2, solid ? 3 : 2,
                      sampled_coordinates(lut));
  if (rgbd) {
    text += "  vec4 stored = texture(table, at);\n";
    text += fmt::format("  return (pow(stored.rgb, vec3(2.2)) / stored.a).{};\n}}\n", swizzle);
  } else {
    text += fmt::format("  return texture(table, at).{};\n}}\n", swizzle);
  }
  return text;
}

std::string hlsl(const LutSource& lut, bool rgbd) {
  check_sampled(lut);
  const bool solid = lut.axes().size() > 2;
  const size_t n = lut.recipe().channels.size();
  const std::string type = n == 1 ? "float" : fmt::format("float{}", n);
  const std::string swizzle = std::string("rgba").substr(0, n);
  std::string text =
      "// Sampler: linear, clamped to the edge; no sRGB; the first row lies at v = 0.\n";
  text += fmt::format("{} {}({} table, SamplerState linear_clamp{}) {{\n", type, function_name(lut),
                      solid ? "Texture3D<float4>" : "Texture2D<float4>", arguments(lut));
  text += fmt::format("  float{} at = float{}({});\n", solid ? 3 : 2, solid ? 3 : 2,
                      sampled_coordinates(lut));
  text += "  float4 stored = table.SampleLevel(linear_clamp, at, 0);\n";
  text += rgbd ? fmt::format("  return (pow(stored.rgb, 2.2) / stored.a).{};\n}}\n", swizzle)
               : fmt::format("  return stored.{};\n}}\n", swizzle);
  return text;
}

// Its own linear filtering over an array of decoded floats.
std::string cpp(const LutSource& lut) {
  const size_t n = lut.recipe().channels.size();
  std::vector<int> counts;
  std::vector<std::string> places;
  for (const TableAxis& axis : lut.axes()) {
    counts.push_back(axis.count);
    const bool center = lut.recipe().alignment == Alignment::Center;
    places.push_back(center ? fmt::format("({}) * {} - 0.5", position(axis), axis.count)
                            : fmt::format("({}) * {}", position(axis), axis.count - 1));
  }
  std::string text = "#include <algorithm>\n#include <array>\n#include <cmath>\n\n";
  text += fmt::format("// texels: {} floats an entry, x fastest, the first row first.\n", n);
  text += fmt::format("inline std::array<float, {}> {}(const float* texels{}) {{\n", n,
                      function_name(lut), arguments(lut));
  text += "  using std::pow;\n  using std::sqrt;\n";
  text += fmt::format("  const int count[] = {{{}}};\n", fmt::join(counts, ", "));
  text += fmt::format("  const double place[] = {{{}}};\n", fmt::join(places, ", "));
  text += fmt::format("  std::array<float, {}> sum{{}};\n", n);
  text += fmt::format("  for (int corner = 0; corner < {}; ++corner) {{\n", 1 << lut.axes().size());
  text += "    double weight = 1;\n    long index = 0, step = 1;\n";
  text += fmt::format("    for (int a = 0; a < {}; ++a) {{\n", lut.axes().size());
  text +=
      "      const double at = std::clamp(place[a], 0.0, count[a] - 1.0);\n"
      "      const int first = std::min(static_cast<int>(at), std::max(count[a] - 2, 0));\n"
      "      const bool next = (corner >> a & 1) != 0;\n"
      "      weight *= next ? at - first : 1 - (at - first);\n"
      "      index += step * std::min(first + (next ? 1 : 0), count[a] - 1);\n"
      "      step *= count[a];\n    }\n";
  text += fmt::format(
      "    for (int c = 0; c < {0}; ++c) {{\n"
      "      sum[c] += static_cast<float>(weight * texels[index * {0} + c]);\n    }}\n",
      n);
  text += "  }\n  return sum;\n}\n";
  return text;
}

}  // namespace

std::string lookup_snippet(LutSource& lut, SnippetLanguage language, const std::string& file,
                           bool rgbd) {
  std::string code;
  if (language == SnippetLanguage::Glsl) code = glsl(lut, rgbd);
  if (language == SnippetLanguage::Hlsl) code = hlsl(lut, rgbd);
  if (language == SnippetLanguage::Cpp) code = cpp(lut);
  return described(lut, file) + code + checks(lut);
}

}  // namespace kiln
