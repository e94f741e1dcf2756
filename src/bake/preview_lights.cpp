// SPDX-License-Identifier: Apache-2.0
#include "preview_lights.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <string_view>

#include "kiln/core/error.h"

namespace kiln {
namespace {

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  while (true) {
    const size_t at = text.find(separator);
    parts.push_back(text.substr(0, at));
    if (at == std::string_view::npos) return parts;
    text.remove_prefix(at + 1);
  }
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  return text;
}

[[noreturn]] void refuse(std::string_view light, const char* expected) {
  throw Error(Fault::Usage,
              fmt::format("light: found '{}', expected {}, e.g. dir:0,1,1:3,3,3", light, expected));
}

Vec3<double> parse_three(std::string_view text, std::string_view light, const char* expected) {
  const std::vector<std::string_view> parts = split(text, ',');
  if (parts.size() != 3) refuse(light, expected);
  double numbers[3];
  for (size_t i = 0; i < 3; ++i) {
    const std::string_view part = trimmed(parts[i]);
    const char* end = part.data() + part.size();
    const auto read = std::from_chars(part.data(), end, numbers[i]);
    if (read.ec != std::errc() || read.ptr != end || !std::isfinite(numbers[i])) {
      refuse(light, expected);
    }
  }
  return {numbers[0], numbers[1], numbers[2]};
}

DirectionalLight parse_light(std::string_view light) {
  const std::vector<std::string_view> parts = split(light, ':');
  if (parts.size() != 3 || trimmed(parts[0]) != "dir") refuse(light, "dir:x,y,z:r,g,b");
  const Vec3<double> toward = parse_three(parts[1], light, "a direction x,y,z to the light");
  const Vec3<double> irradiance = parse_three(parts[2], light, "an irradiance r,g,b [W/m^2]");
  const double reach = std::hypot(toward.x, toward.y, toward.z);
  if (!(reach > 0) || !std::isfinite(reach)) refuse(light, "a direction that is not 0,0,0");
  if (irradiance.x < 0 || irradiance.y < 0 || irradiance.z < 0) {
    refuse(light, "an irradiance of at least 0");
  }
  return {toward * (1 / reach), irradiance};
}

}  // namespace

std::vector<DirectionalLight> parse_lights(const std::string& text) {
  std::vector<DirectionalLight> lights;
  if (trimmed(text).empty()) return lights;
  for (const std::string_view light : split(text, ';'))
    lights.push_back(parse_light(trimmed(light)));
  return lights;
}

}  // namespace kiln
