// SPDX-License-Identifier: Apache-2.0
#include "kiln/material/resolver.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "given_maps.h"
#include "kiln/core/error.h"
#include "slot_values.h"
#include "workflow_reads.h"

namespace kiln {
namespace {

/// Rows of a material on their way from named maps to an SVBRDF. Maps are released as they are
/// read.
struct RowsInWork {
  SlotMaps maps;
  Workflow workflow;
  const std::vector<Slot>& read;
  Size size;
  Repairs& repairs;
  Svbrdf svbrdf;
};

// Values beyond their bounds by less than this are rounding and go uncounted.
constexpr float rounding = 1e-4f;

void repair(Plane& plane, Bounds bounds, float replacement, Repairs::OfSlot& repairs) {
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

// What is given for a slot, or its constant, as one plane a channel: 1x1 for constants. A grey
// image fills every channel of a colour.
std::vector<Plane> take_planes(RowsInWork& work, Slot slot) {
  const SlotFacts& facts = slot_facts(slot);
  std::vector<Plane> planes;
  if (given_image(work.maps, slot)) {
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

Plane spread(Plane plane, Size size) {
  return plane.size() == Size{1, 1} && size != Size{1, 1} ? Plane(size, plane.at(0, 0))
                                                          : std::move(plane);
}

// The planes of a slot, finite and within bounds.
std::vector<Plane> read_slot(RowsInWork& work, Slot slot) {
  const SlotFacts& facts = slot_facts(slot);
  const Bounds bounds = bounds_of(work.maps, slot);
  Repairs::OfSlot& repairs = work.repairs.slots[static_cast<size_t>(slot)];
  Repairs::OfSlot of_constant;
  const bool is_image = given_image(work.maps, slot) != nullptr;
  std::vector<Plane> planes = take_planes(work, slot);
  for (size_t c = 0; c < planes.size(); ++c) {
    repair(planes[c], bounds, facts.missing[c], is_image ? repairs : of_constant);
    planes[c] = spread(std::move(planes[c]), work.size);
  }
  while (static_cast<int>(planes.size()) < facts.channels) planes.push_back(planes[0]);
  return planes;
}

Layers one_texel(const std::array<float, 3>& value) {
  Layers texel = make_layers({1, 1}, {"R", "G", "B"});
  for (size_t c = 0; c < 3; ++c) texel.layers[c].plane.at(0, 0) = value[c];
  return texel;
}

std::array<Plane, 3> read_normal(RowsInWork& work, const NormalDecoding& decoding) {
  const auto found = work.maps.find(Slot::Normal);
  if (found == work.maps.end()) {
    return {Plane(work.size), Plane(work.size), Plane(work.size, 1.0f)};
  }
  SlotMap& map = found->second;
  if (map.value) map.image = one_texel(*map.value);
  DecodedNormals decoded =
      with_context("normal " + map.source, [&] { return decode_normals(map.image, decoding); });
  map.image.layers.clear();
  if (map.value) {
    for (Plane& plane : decoded.normal) plane = spread(std::move(plane), work.size);
  } else {
    work.repairs.normals += area(work.size);
    work.repairs.not_unit += decoded.not_unit;
    work.repairs.degenerate += decoded.degenerate;
    work.repairs.below_surface += decoded.below_surface;
    work.repairs.unreadable_normals += decoded.unreadable;
  }
  return std::move(decoded.normal);
}

template <class Function>
void for_each_texel(Plane& plane, Function function) {
  for (int y = 0; y < plane.height(); ++y) {
    float* v = plane.row(y);
    for (int x = 0; x < plane.width(); ++x) v[x] = function(v[x]);
  }
}

Plane read_roughness(RowsInWork& work) {
  const Slot slot = choose(work.maps, workflow_reads(work.workflow).width);
  Plane plane = std::move(read_slot(work, slot)[0]);
  if (slot == Slot::Gloss) for_each_texel(plane, [](float gloss) { return 1.0f - gloss; });
  return plane;
}

// Reflectance that a specular level stands for; without a map, its constant is of encoding Level.
Plane read_level(RowsInWork& work) {
  const auto found = work.maps.find(Slot::SpecularLevel);
  const SpecularEncoding encoding =
      found == work.maps.end() ? SpecularEncoding::Level : found->second.encoding;
  Plane plane = std::move(read_slot(work, Slot::SpecularLevel)[0]);
  for_each_texel(plane, [encoding](float value) { return f0_of(encoding, value); });
  return plane;
}

bool is_read(const RowsInWork& work, Slot slot) {
  return std::count(work.read.begin(), work.read.end(), slot) > 0;
}

// The same tinted and weighed: one plane, or three where there is a tint.
std::vector<Plane> read_dielectric(RowsInWork& work) {
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

Plane read_angle(RowsInWork& work, bool y_down) {
  SlotMap& map = work.maps.at(Slot::AnisotropyAngle);
  Plane angle = map.value ? Plane(work.size, (*map.value)[0]) : angle_of_axes(map.image);
  Repairs::OfSlot& repairs = work.repairs.slots[static_cast<size_t>(Slot::AnisotropyAngle)];
  repairs.unreadable += replace_unreadable(angle);
  if (y_down) for_each_texel(angle, [](float value) { return -value; });
  return angle;
}

// Strength as an SVBRDF holds it; models that widen the lobe by it take the roughness along.
void read_anisotropy(RowsInWork& work, bool y_down) {
  if (!is_read(work, Slot::Anisotropy)) return;
  Svbrdf& svbrdf = work.svbrdf;
  const AnisotropyEncoding encoding = work.maps.at(Slot::Anisotropy).decoding.anisotropy;
  svbrdf.anisotropy = std::move(read_slot(work, Slot::Anisotropy)[0]);
  bring_to_shape(encoding, svbrdf.roughness, svbrdf.anisotropy);
  if (is_read(work, Slot::AnisotropyAngle)) svbrdf.anisotropy_angle = read_angle(work, y_down);
}

std::array<Plane, 3> colors(std::vector<Plane> planes) {
  return {std::move(planes[0]), std::move(planes[1]), std::move(planes[2])};
}

// F0 = lerp(dielectric, base, metallic) and diffuse = base (1 - metallic).
void split_by_metallic(RowsInWork& work) {
  Svbrdf& svbrdf = work.svbrdf;
  const Plane metallic = std::move(read_slot(work, Slot::Metallic)[0]);
  const std::vector<Plane> dielectric = read_dielectric(work);
  for (size_t c = 0; c < 3; ++c) {
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

void read_colors(RowsInWork& work) {
  Svbrdf& svbrdf = work.svbrdf;
  const WorkflowReads& reads = workflow_reads(work.workflow);
  svbrdf.diffuse_color = colors(read_slot(work, choose(work.maps, reads.color)));
  if (!reads.metal.empty()) return split_by_metallic(work);
  const Slot specular = choose(work.maps, reads.specular);
  if (specular == Slot::SpecularColor) {
    svbrdf.f0 = colors(read_slot(work, specular));
  } else {
    std::vector<Plane> dielectric = read_dielectric(work);
    while (dielectric.size() < 3) dielectric.push_back(dielectric[0]);
    svbrdf.f0 = colors(std::move(dielectric));
  }
}

// Of the maps that are read; constants have no size.
Size largest_size(const SlotMaps& maps, const std::vector<Slot>& read) {
  Size largest{1, 1};
  for (const Slot slot : read) {
    const SlotMap* map = given_image(maps, slot);
    if (!map) continue;
    const Size size = map->image.size;
    if (std::pair(area(size), size) > std::pair(area(largest), largest)) largest = size;
  }
  return largest;
}

std::string described(Slot slot, const SlotMap& map) {
  return fmt::format("{} {} ({}x{})", slot_name(slot), map.source, map.image.size.width,
                     map.image.size.height);
}

// More than rounding to whole texels explains.
bool has_other_aspect(Size size, Size wanted) {
  const double height = static_cast<double>(size.width) * wanted.height / wanted.width;
  const double width = static_cast<double>(size.height) * wanted.width / wanted.height;
  const double off = std::min(std::abs(height - size.height), std::abs(width - size.width));
  return off > 1 && std::abs(height / size.height - 1) > 0.01;
}

void require_one_aspect(const SlotMaps& maps, const std::vector<Slot>& read, Size size) {
  const auto of_size = std::find_if(read.begin(), read.end(), [&](Slot slot) {
    const SlotMap* map = given_image(maps, slot);
    return map && map->image.size == size;
  });
  for (const Slot slot : read) {
    const SlotMap* map = given_image(maps, slot);
    if (!map || area(map->image.size) == 0 || !has_other_aspect(map->image.size, size)) continue;
    throw Error(Fault::Input,
                fmt::format("{} and {} cannot belong together: their aspects differ",
                            described(*of_size, maps.at(*of_size)), described(slot, *map)));
  }
}

}  // namespace

void Repairs::add(const Repairs& other) {
  for (size_t i = 0; i < slots.size(); ++i) {
    slots[i].clamped += other.slots[i].clamped;
    slots[i].unreadable += other.slots[i].unreadable;
  }
  normals += other.normals;
  not_unit += other.not_unit;
  degenerate += other.degenerate;
  below_surface += other.below_surface;
  unreadable_normals += other.unreadable_normals;
}

Bounds bounds_of(const SlotMaps& maps, Slot slot) {
  const auto found = maps.find(slot);
  const bool is_ior = slot == Slot::SpecularLevel && found != maps.end() &&
                      found->second.encoding == SpecularEncoding::Ior;
  if (is_ior) return {1.0f, 1000.0f};
  if (slot == Slot::Anisotropy && found != maps.end() &&
      found->second.decoding.anisotropy == AnisotropyEncoding::Burley) {
    return {0.0f, most_anisotropic};
  }
  return slot == Slot::SpecularTint ? Bounds{0.0f, 1000.0f} : Bounds{};
}

Slot choose(const SlotMaps& maps, const std::vector<Slot>& alternatives) {
  for (const Slot slot : alternatives) {
    if (maps.count(slot)) return slot;
  }
  return alternatives.front();
}

const SlotMap* given_image(const SlotMaps& maps, Slot slot) {
  const auto found = maps.find(slot);
  return found == maps.end() || found->second.value ? nullptr : &found->second;
}

Resolver::Resolver(SlotMaps heads, const WorkflowSettings& settings,
                   std::optional<NormalForm> normal)
    : heads_(std::move(heads)), settings_(settings), normal_(std::move(normal)) {
  std::vector<Slot> given;
  for (const auto& [slot, map] : heads_) given.push_back(slot);
  read_ = slots_read(settings_.workflow, given);
  size_ = shared_size(heads_, read_);
  for (auto& [slot, map] : heads_) {
    if (map.value) decode_slot(slot, map);
  }
}

Size shared_size(const SlotMaps& heads, const std::vector<Slot>& slots) {
  const Size size = largest_size(heads, slots);
  require_one_aspect(heads, slots, size);
  return size;
}

Svbrdf Resolver::rows(SlotMaps maps, Repairs& repairs) const {
  Size size{size_.width, 1};
  for (const auto& [slot, map] : maps) size.height = std::max(size.height, map.image.size.height);
  for (const auto& [slot, map] : heads_) {
    if (map.value) maps[slot] = map;
  }
  RowsInWork work{std::move(maps), settings_.workflow, read_, size, repairs, {}};
  NormalDecoding decoding;  // of a constant, which is what it says
  decoding.zero = settings_.normal_zero;
  decoding.range = settings_.normal_range;
  if (heads_.count(Slot::Normal)) decoding.strength = heads_.at(Slot::Normal).decoding.scale[0];
  work.svbrdf.size = size;
  work.svbrdf.wrap = settled(settings_.wrap);
  work.svbrdf.normal = read_normal(work, normal_ ? normal_->decoding : decoding);
  work.svbrdf.ambient_occlusion = std::move(read_slot(work, Slot::AmbientOcclusion)[0]);
  work.svbrdf.roughness = read_roughness(work);
  read_anisotropy(work, normal_ && normal_->decoding.convention == NormalConvention::DirectX);
  read_colors(work);
  return std::move(work.svbrdf);
}

}  // namespace kiln
