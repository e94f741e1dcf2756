// SPDX-License-Identifier: Apache-2.0
#include "color_planes.h"

#include "kiln/core/error.h"

namespace kiln {
namespace {

std::string names_of(const Layers& image) {
  std::string names;
  for (const Layer& layer : image.layers) names += (names.empty() ? "" : " ") + layer.name;
  return names.empty() ? "none" : names;
}

}  // namespace

ColorPlanes color_planes(const Layers& latlong) {
  if (latlong.size.width < 1 || latlong.size.height < 1) {
    throw Error(Fault::Input, "the environment image is empty");
  }
  const Plane* r = latlong.find("R");
  const Plane* g = latlong.find("G");
  const Plane* b = latlong.find("B");
  if (r && g && b) return {latlong.size, {r, g, b}};
  const Plane* grey = latlong.find("Y");
  if (!grey && latlong.layers.size() == 1) grey = &latlong.layers.front().plane;
  if (grey) return {latlong.size, {grey, grey, grey}};
  throw Error(Fault::Input, "the environment image has channels " + names_of(latlong) +
                                "; expected R, G and B or one grey channel");
}

}  // namespace kiln
