// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "kiln/core/error.h"
#include "kiln/image/resample.h"
#include "kiln/material/workflow.h"
#include "slot_values.h"
#include "workflow_reads.h"

namespace kiln {
namespace {

/// A material on its way from named maps to an SVBRDF. Maps are released as they are read.
struct Resolution {
  SlotMaps maps;
  WorkflowSettings settings;
  std::vector<Slot> read;  ///< the given slots that matter
  Size size;
  bool y_down = false;  ///< the normal map was DirectX's, and with it the angles of anisotropy
  Resolved result;

  template <class... Args>
  void note(fmt::format_string<Args...> text, Args&&... args) {
    result.notes.push_back(fmt::format(text, std::forward<Args>(args)...));
  }
  template <class... Args>
  void warn(fmt::format_string<Args...> text, Args&&... args) {
    result.warnings.push_back(fmt::format(text, std::forward<Args>(args)...));
  }
};

// The first given slot of the list, else the first: its constant stands in.
Slot choose(const Resolution& work, const std::vector<Slot>& alternatives) {
  for (const Slot slot : alternatives) {
    if (work.maps.count(slot)) return slot;
  }
  return alternatives.front();
}

const SlotMap* given_image(const Resolution& work, Slot slot) {
  const auto found = work.maps.find(slot);
  return found == work.maps.end() || found->second.value ? nullptr : &found->second;
}

bool is_read(const Resolution& work, Slot slot) {
  return std::count(work.read.begin(), work.read.end(), slot) > 0;
}

void check_images(const Resolution& work) {
  for (const Slot slot : work.read) {
    const SlotMap* map = given_image(work, slot);
    if (map && (map->image.layers.empty() || area(map->image.size) == 0)) {
      throw Error(Fault::Input,
                  fmt::format("{} {}: the map has no texels", slot_name(slot), map->source));
    }
  }
}

void note_missing(Resolution& work) {
  for (const std::vector<Slot>& alternatives : alternatives_of(work.settings.workflow)) {
    const Slot wanted = alternatives.front();
    const Slot slot = choose(work, alternatives);
    if (slot != wanted) {
      work.note("{}: no map, {} is read instead", slot_name(wanted), slot_name(slot));
    } else if (!work.maps.count(slot)) {
      const std::string constant = slot == Slot::Normal
                                       ? std::string("flat")
                                       : fmt::format("constant {}", slot_facts(slot).missing[0]);
      work.note("{}: no map, {}", slot_name(slot), constant);
    }
  }
}

void note_unread(Resolution& work) {
  for (const auto& [slot, map] : work.maps) {
    if (std::find(work.read.begin(), work.read.end(), slot) != work.read.end()) continue;
    if (slot == Slot::Emissive || slot == Slot::Opacity) {
      work.note("{}: not rendered, ignored", slot_name(slot));
    } else if (slot == Slot::Height) {
      work.note("height: not displaced; at most it tells OpenGL from DirectX normals");
    } else {
      work.note("{}: not read by {}", slot_name(slot), workflow_name(work.settings.workflow));
    }
  }
}

// Of the maps that are read; constants have no size.
Size largest_size(const Resolution& work) {
  Size largest{1, 1};
  for (const Slot slot : work.read) {
    const SlotMap* map = given_image(work, slot);
    if (!map) continue;
    const Size size = map->image.size;
    if (std::pair(area(size), size) > std::pair(area(largest), largest)) largest = size;
  }
  return largest;
}

std::string text_of(Size size) { return fmt::format("{}x{}", size.width, size.height); }

void note_fit(Resolution& work, Slot slot, Size size) {
  if (size == work.size) return;
  work.note("{} {} resampled to {}", slot_name(slot), text_of(size), text_of(work.size));
  const double aspect = static_cast<double>(size.width) / size.height;
  const double wanted = static_cast<double>(work.size.width) / work.size.height;
  if (std::abs(aspect / wanted - 1) > 0.01) {
    work.warn("{} {} has another aspect than {}", slot_name(slot), text_of(size),
              text_of(work.size));
  }
}

struct Bounds {
  float low = 0;
  float high = 1;
};

struct Repairs {
  long long clamped = 0;
  long long unreadable = 0;
};

// Values beyond their bounds by less than this are rounding and go uncounted.
constexpr float rounding = 1e-4f;

void repair(Plane& plane, Bounds bounds, float replacement, Repairs& repairs) {
  for (int y = 0; y < plane.height(); ++y) {
    float* v = plane.row(y);
    int clamped = 0, unreadable = 0;
    for (int x = 0; x < plane.width(); ++x) {
      const bool finite = std::isfinite(v[x]);
      const float value = finite ? v[x] : replacement;
      unreadable += !finite;
      clamped += value < bounds.low - rounding || value > bounds.high + rounding;
      v[x] = std::clamp(value, bounds.low, bounds.high);
    }
    repairs.clamped += clamped;
    repairs.unreadable += unreadable;
  }
}

void note_repairs(Resolution& work, Slot slot, Bounds bounds, const Repairs& repairs) {
  if (repairs.unreadable > 0) {
    work.warn("{}: {} values are NaN or Inf, replaced by {}", slot_name(slot), repairs.unreadable,
              slot_facts(slot).missing[0]);
  }
  if (repairs.clamped > 0) {
    work.warn("{}: {} values clamped to [{}, {}]", slot_name(slot), repairs.clamped, bounds.low,
              bounds.high);
  }
}

Bounds bounds_of(const Resolution& work, Slot slot) {
  const auto found = work.maps.find(slot);
  const bool is_ior = slot == Slot::SpecularLevel && found != work.maps.end() &&
                      found->second.encoding == SpecularEncoding::Ior;
  return is_ior ? Bounds{1.0f, 1000.0f} : Bounds{};
}

// What is given for a slot, or its constant, as one plane a channel: 1x1 for constants. A grey
// image fills every channel of a colour.
std::vector<Plane> take_planes(Resolution& work, Slot slot) {
  const SlotFacts& facts = slot_facts(slot);
  std::vector<Plane> planes;
  if (given_image(work, slot)) {
    for (Layer& layer : work.maps.at(slot).image.layers) {
      if (layer.name != "A" || planes.empty()) planes.push_back(std::move(layer.plane));
    }
    if (planes.size() < 3 && facts.channels == 3) planes.resize(1);
    work.maps.at(slot).image.layers.clear();
  } else {
    const bool missing = !work.maps.count(slot);
    for (const float value : missing ? facts.missing : *work.maps.at(slot).value) {
      planes.emplace_back(Size{1, 1}, value);
    }
  }
  if (static_cast<int>(planes.size()) > facts.channels) planes.resize(facts.channels);
  return planes;
}

Plane fit(Plane plane, Size size) {
  if (plane.size() == size) return plane;
  if (plane.size() == Size{1, 1}) return Plane(size, plane.at(0, 0));
  return resample(plane, size);
}

// The planes of a slot, finite and within bounds, at the final size.
std::vector<Plane> read_slot(Resolution& work, Slot slot) {
  const SlotFacts& facts = slot_facts(slot);
  const Bounds bounds = bounds_of(work, slot);
  if (const SlotMap* map = given_image(work, slot)) note_fit(work, slot, map->image.size);
  std::vector<Plane> planes = take_planes(work, slot);
  Repairs repairs;
  for (size_t c = 0; c < planes.size(); ++c) {
    repair(planes[c], bounds, facts.missing[c], repairs);
    planes[c] = fit(std::move(planes[c]), work.size);
  }
  while (static_cast<int>(planes.size()) < facts.channels) planes.push_back(planes[0]);
  note_repairs(work, slot, bounds, repairs);
  return planes;
}

// Stated, else in the map's name, else by the height map, else OpenGL with a warning.
NormalConvention settle_convention(Resolution& work, const std::array<Plane, 3>& normal) {
  const auto told = [&](NormalConvention convention, std::string_view why) {
    work.note("normal: {}, {}", convention_text(convention), why);
    return convention;
  };
  const SlotMap& map = work.maps.at(Slot::Normal);
  if (work.settings.normal != NormalConvention::Auto)
    return told(work.settings.normal, "as stated");
  if (map.convention != NormalConvention::Auto) {
    return told(map.convention, "as its name or its naming scheme says");
  }
  const SlotMap* height = given_image(work, Slot::Height);
  if (height && !height->image.layers.empty()) {
    const ConventionGuess guess = guess_convention(normal, height->image.layers[0].plane);
    if (guess.convention != NormalConvention::Auto) {
      return told(guess.convention, "by the height map: " + guess.reason);
    }
    work.note("normal: the height map does not tell the convention: {}", guess.reason);
  }
  const ConventionGuess guess = guess_convention(normal);
  const std::string hint =
      guess.convention == NormalConvention::Auto
          ? std::string("its slopes do not tell")
          : fmt::format("its slopes suggest {}", convention_text(guess.convention));
  work.warn(
      "normal: neither the name {} nor a height map tells OpenGL from DirectX, read as "
      "OpenGL; {} ({})",
      map.source, hint, guess.reason);
  return NormalConvention::OpenGl;
}

void note_normals(Resolution& work, const DecodedNormals& decoded) {
  if (decoded.two_channel) work.note("normal: two channels, z rebuilt from x and y");
  if (decoded.signed_range) work.note("normal: stored as [-1, 1]");
  if (decoded.degenerate) work.note("normal: {} without direction, made flat", decoded.degenerate);
  if (decoded.below_surface) {
    work.note("normal: {} below the surface, raised above it", decoded.below_surface);
  }
  if (decoded.unreadable) work.warn("normal: {} are NaN or Inf, made flat", decoded.unreadable);
}

void make_unit(std::array<Plane, 3>& normal) {
  for (int row = 0; row < normal[0].height(); ++row) {
    float *x = normal[0].row(row), *y = normal[1].row(row), *z = normal[2].row(row);
    for (int i = 0; i < normal[0].width(); ++i) {
      const float inverse = 1.0f / std::sqrt(x[i] * x[i] + y[i] * y[i] + z[i] * z[i]);
      x[i] *= inverse;
      y[i] *= inverse;
      z[i] *= inverse;
    }
  }
}

std::array<Plane, 3> read_normal(Resolution& work) {
  if (!work.maps.count(Slot::Normal)) {
    return {Plane(work.size, 0.0f), Plane(work.size, 0.0f), Plane(work.size, 1.0f)};
  }
  SlotMap& map = work.maps.at(Slot::Normal);
  const bool constant = map.value.has_value();
  if (constant) {
    map.image = make_layers({1, 1}, {"R", "G", "B"});
    for (int c = 0; c < 3; ++c) map.image.layers[c].plane.at(0, 0) = (*map.value)[c];
  }
  DecodedNormals decoded = with_context("normal " + map.source, [&] {
    return decode_normals(map.image, {NormalConvention::OpenGl, work.settings.normal_zero,
                                      work.settings.normal_range, map.decoding.scale[0]});
  });
  map.image.layers.clear();
  if (!constant) {
    note_normals(work, decoded);
    note_fit(work, Slot::Normal, decoded.normal[0].size());
    work.y_down = settle_convention(work, decoded.normal) == NormalConvention::DirectX;
    if (work.y_down) flip_y(decoded.normal);
  }
  if (decoded.normal[0].size() == work.size) return std::move(decoded.normal);
  for (Plane& plane : decoded.normal) plane = fit(std::move(plane), work.size);
  make_unit(decoded.normal);
  return std::move(decoded.normal);
}

template <class Function>
void for_each_texel(Plane& plane, Function function) {
  for (int y = 0; y < plane.height(); ++y) {
    float* v = plane.row(y);
    for (int x = 0; x < plane.width(); ++x) v[x] = function(v[x]);
  }
}

Plane read_roughness(Resolution& work) {
  const Slot slot = choose(work, workflow_reads(work.settings.workflow).width);
  Plane plane = std::move(read_slot(work, slot)[0]);
  if (slot == Slot::Gloss) for_each_texel(plane, [](float gloss) { return 1.0f - gloss; });
  return plane;
}

// Reflectance that a specular level stands for; without a map, its constant is of encoding Level.
Plane read_level(Resolution& work) {
  const auto found = work.maps.find(Slot::SpecularLevel);
  const SpecularEncoding encoding =
      found == work.maps.end() ? SpecularEncoding::Level : found->second.encoding;
  Plane plane = std::move(read_slot(work, Slot::SpecularLevel)[0]);
  for_each_texel(plane, [encoding](float value) { return f0_of(encoding, value); });
  return plane;
}

// The same tinted and weighed: one plane, or three where there is a tint.
std::vector<Plane> read_dielectric(Resolution& work) {
  std::vector<Plane> f0;
  f0.push_back(read_level(work));
  if (is_read(work, Slot::SpecularTint)) {
    std::vector<Plane> tinted = read_slot(work, Slot::SpecularTint);
    for (Plane& plane : tinted) multiply(plane, f0[0], 1.0f);
    f0 = std::move(tinted);
  }
  if (is_read(work, Slot::SpecularWeight)) {
    const Plane weight = std::move(read_slot(work, Slot::SpecularWeight)[0]);
    for (Plane& plane : f0) multiply(plane, weight, 1.0f);
  }
  return f0;
}

// Angles turn round, so it is their direction that is resampled.
Plane read_angle(Resolution& work) {
  Plane angle = std::move(take_planes(work, Slot::AnisotropyAngle)[0]);
  if (work.y_down) for_each_texel(angle, [](float value) { return -value; });
  if (angle.size() == Size{1, 1}) return fit(std::move(angle), work.size);
  note_fit(work, Slot::AnisotropyAngle, angle.size());
  const long long unreadable = replace_unreadable(angle);
  if (unreadable > 0) work.warn("anisotropy_angle: {} are NaN or Inf, made 0", unreadable);
  return resample_angle(std::move(angle), work.size);
}

// Strength as an SVBRDF holds it; models that widen the lobe by it take the roughness along.
void read_anisotropy(Resolution& work) {
  if (!is_read(work, Slot::Anisotropy)) return;
  Svbrdf& svbrdf = work.result.svbrdf;
  const AnisotropyEncoding encoding = work.maps.at(Slot::Anisotropy).decoding.anisotropy;
  svbrdf.anisotropy = std::move(read_slot(work, Slot::Anisotropy)[0]);
  bring_to_shape(encoding, svbrdf.roughness, svbrdf.anisotropy);
  if (is_read(work, Slot::AnisotropyAngle)) svbrdf.anisotropy_angle = read_angle(work);
}

std::array<Plane, 3> colors(std::vector<Plane> planes) {
  return {std::move(planes[0]), std::move(planes[1]), std::move(planes[2])};
}

// F0 = lerp(dielectric, base, metallic) and diffuse = base (1 - metallic).
void split_by_metallic(Resolution& work) {
  Svbrdf& svbrdf = work.result.svbrdf;
  const Plane metallic = std::move(read_slot(work, Slot::Metallic)[0]);
  const std::vector<Plane> dielectric = read_dielectric(work);
  for (int c = 0; c < 3; ++c) {
    svbrdf.f0[c] = Plane(work.size);
    for (int y = 0; y < work.size.height; ++y) {
      const float *m = metallic.row(y), *d = dielectric[dielectric.size() == 3 ? c : 0].row(y);
      float *base = svbrdf.diffuse_color[c].row(y), *f0 = svbrdf.f0[c].row(y);
      for (int x = 0; x < work.size.width; ++x) {
        f0[x] = d[x] * (1.0f - m[x]) + base[x] * m[x];
        base[x] *= 1.0f - m[x];
      }
    }
  }
}

void read_colors(Resolution& work) {
  Svbrdf& svbrdf = work.result.svbrdf;
  const WorkflowReads& reads = workflow_reads(work.settings.workflow);
  svbrdf.diffuse_color = colors(read_slot(work, choose(work, reads.color)));
  if (!reads.metal.empty()) return split_by_metallic(work);
  const Slot specular = choose(work, reads.specular);
  if (specular == Slot::SpecularColor) {
    svbrdf.f0 = colors(read_slot(work, specular));
  } else {
    std::vector<Plane> dielectric = read_dielectric(work);
    while (dielectric.size() < 3) dielectric.push_back(dielectric[0]);
    svbrdf.f0 = colors(std::move(dielectric));
  }
}

}  // namespace

Resolved resolve(SlotMaps maps, const WorkflowSettings& settings) {
  Resolution work{std::move(maps), settings, {}, {}, false, {}};
  std::vector<Slot> given;
  for (const auto& [slot, map] : work.maps) given.push_back(slot);
  work.read = slots_read(settings.workflow, given);
  check_images(work);
  for (const Slot slot : work.read) {
    if (work.maps.count(slot)) decode_slot(slot, work.maps.at(slot));
  }
  note_missing(work);
  note_unread(work);
  work.size = largest_size(work);
  Svbrdf& svbrdf = work.result.svbrdf;
  svbrdf.size = work.size;
  svbrdf.normal = read_normal(work);
  svbrdf.ambient_occlusion = std::move(read_slot(work, Slot::AmbientOcclusion)[0]);
  svbrdf.roughness = read_roughness(work);
  read_anisotropy(work);
  read_colors(work);
  return std::move(work.result);
}

}  // namespace kiln
