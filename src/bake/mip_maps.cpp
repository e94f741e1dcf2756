// SPDX-License-Identifier: Apache-2.0
#include "mip_maps.h"

#include <algorithm>
#include <cmath>

#include "kiln/image/mip_levels.h"
#include "kiln/material/normals.h"
#include "kiln/math/sums.h"
#include "kiln/math/wide.h"
#include "map_files.h"

namespace kiln {
namespace {

using W = WideFloat;
constexpr int lanes = lane_count<W>;

W at(const float* row, int x) { return load_lanes<W>(row + x); }

// Beside opacity: where all is transparent, colours weigh alike; elsewhere it is below rounding.
constexpr float least_weight = 0x1p-20f;

Layers named(const Layers& image, const std::vector<std::string>& names) {
  Layers result{image.size, {}};
  for (size_t c = 0; c < names.size(); ++c) {
    result.layers.push_back({names[c], image.layers[std::min(c, image.layers.size() - 1)].plane});
  }
  return result;
}

double sum_of_layer(int width, const float* row) {
  return sum_of({row, static_cast<size_t>(width)});
}

const Plane& plane_of(const SlotMaps& maps, Slot slot, size_t channel) {
  const auto& layers = maps.at(slot).image.layers;
  return layers[std::min(channel, layers.size() - 1)].plane;
}

MipFile file_of(const GivenMap& map) {
  MipFile file;
  file.name = std::string(slot_name(map.slot));
  file.names = channel_names(static_cast<size_t>(map.channels));
  file.preferred_type = map.stored_type;
  file.attributes = {{"kiln:quantity", file.name}, {"kiln:filter", "box"}};
  return file;
}

void copy_rows(int width, size_t count, const float* const* numbers, float* const* layers) {
  for (size_t c = 0; c < count; ++c) std::copy_n(numbers[c], width, layers[c]);
}

// Colours times opacity, and that weight.
void fill_weighted(const MipBand& band, Slot slot, int y, float* const* numbers) {
  const float* opacity = plane_of(band.stored, Slot::Opacity, 0).row(y);
  for (size_t c = 0; c < 3; ++c) {
    const Plane& plane = plane_of(band.linear, slot, c);
    const float* color = plane.row(y);
    for (int x = 0; x < plane.width(); x += lanes) {
      const W weight = max(at(opacity, x), W(0)) + W(least_weight);
      store_lanes(numbers[c] + x, W(at(color, x) * weight));
      if (c == 0) store_lanes(numbers[3] + x, weight);
    }
  }
}

void unweigh(int width, const float* const* numbers, float* const* layers) {
  for (int x = 0; x < width; x += lanes) {
    const W scale = W(1) / at(numbers[3], x);
    for (size_t c = 0; c < 3; ++c) store_lanes(layers[c] + x, W(at(numbers[c], x) * scale));
  }
}

/// How components of normals become stored numbers.
struct NormalEncoding {
  float scale = 0.5f, zero = 0.5f;  ///< of x and y
  float up = 1.0f;                  ///< -1: DirectX
  bool is_signed = false;

  explicit NormalEncoding(const NormalDecoding& decoding) {
    is_signed = decoding.range == NormalRange::Signed;
    if (is_signed) {
      scale = 1.0f;
      zero = 0.0f;
    } else if (decoding.zero == NormalZero::Code127) {
      zero = 127.0f / 255;
    } else if (decoding.zero == NormalZero::Code128) {
      zero = 128.0f / 255;
    }
    if (decoding.convention == NormalConvention::DirectX) up = -1.0f;
  }
};

// The normal of the mean slopes, as its file stores it.
void store_normals(const NormalEncoding& encoding, size_t channels, int width,
                   const float* const* slopes, float* const* layers) {
  const W scale(encoding.scale), zero(encoding.zero), up(encoding.up * encoding.scale);
  const W z_scale(encoding.is_signed ? 1.0f : 0.5f), z_zero(encoding.is_signed ? 0.0f : 0.5f);
  for (int i = 0; i < width; i += lanes) {
    const W x = at(slopes[0], i), y = at(slopes[1], i);
    const W z = W(1) / sqrt(fma(x, x, fma(y, y, W(1))));
    store_lanes(layers[0] + i, W(fma(scale * z, x, zero)));
    store_lanes(layers[1] + i, W(fma(up * z, y, zero)));
    if (channels > 2) store_lanes(layers[2] + i, W(fma(z_scale, z, z_zero)));
  }
}

SurfaceRow surface_row(const MipBand& band, bool has_normals, int y) {
  SurfaceRow row{band.roughness.width(), band.roughness.row(y)};
  for (size_t c = 0; c < 3 && has_normals; ++c) row.normal[c] = band.normal[c].row(y);
  return row;
}

// Without a normal map there is nothing to widen by.
NormalFiltering filtering_of(const MipChoice& choice) {
  NormalFiltering filtering = choice.normals;
  if (!choice.form) filtering.method = NormalFilter::None;
  return filtering;
}

double sum_of_fourth_powers(int width, const float* row) {
  const auto fourth = [row](auto i) { return square(square(static_cast<double>(row[i]))); };
  return sum_of_terms(
      static_cast<size_t>(width),
      [row](size_t i) { return WideDouble(square(square(load_as_double(row + i)))); }, fourth);
}

MipMap lobe_mips(const std::string& name, const std::vector<std::string>& layers,
                 const std::string& type, const MipChoice& choice) {
  const NormalFiltering filtering = filtering_of(choice);
  MipMap mips;
  mips.file.name = name;
  mips.file.names = layers;
  mips.file.preferred_type = type.empty() ? "uint8" : type;
  mips.file.attributes = {
      {"kiln:quantity", name},
      {"kiln:filter", "box"},
      {"kiln:method", std::string(normal_filter_names[static_cast<size_t>(filtering.method)])}};
  mips.channels = moment_count(filtering.method);
  const bool has_normals = filtering.method != NormalFilter::None;
  mips.fill = [filtering, has_normals](const MipBand& band, int y, float* const* numbers) {
    fill_moments(filtering.method, surface_row(band, has_normals, y), numbers);
  };
  return mips;
}

// The factor that lifts that share of the texels above the limit, and no others.
float coverage_scale(const Plane& opacity, double share, float limit) {
  std::vector<float> values;
  values.reserve(static_cast<size_t>(area(opacity.size())));
  for (int y = 0; y < opacity.height(); ++y) {
    const auto row = opacity.texels_of_row(y);
    values.insert(values.end(), row.begin(), row.end());
  }
  const auto count = std::lround(share * static_cast<double>(values.size()));
  if (count <= 0 || static_cast<size_t>(count) >= values.size()) return 1.0f;
  const auto cut = values.end() - count;
  std::nth_element(values.begin(), cut, values.end());
  const float value = *cut;
  // Texels of one value are solid together or not at all: whichever comes nearer.
  long over = 0, same = 0;
  float lower = 0.0f, higher = 1.0f;
  for (const float v : values) {
    over += v > value;
    same += v == value;
    if (v < value) lower = std::max(lower, v);
    if (v > value) higher = std::min(higher, v);
  }
  const bool solid = over + same - count <= count - over;
  const float middle = 0.5f * (value + (solid ? lower : higher));
  return middle > 0 ? limit / middle : 1.0f;
}

// Colours with the opacity that stands in the same file.
MipMap with_opacity(MipMap mips, Slot slot, const MipChoice& choice) {
  const std::vector<std::string> names{"R", "G", "B", "A"};
  mips.file.names = names;
  mips.first = [slot, names](const MipBand& band) {
    Layers image = named(band.stored.at(slot).image, {"R", "G", "B"});
    image.layers.push_back({"A", plane_of(band.stored, Slot::Opacity, 0)});
    return image;
  };
  mips.store = [scales = choice.opacity_scales](int level, int width, const float* const* numbers,
                                                float* const* layers) {
    unweigh(width, numbers, layers);
    const float scale = scales.empty() ? 1.0f : scales[static_cast<size_t>(level)];
    for (int x = 0; x < width; ++x) {
      const float opacity = std::max(0.0f, numbers[3][x] - least_weight);
      layers[3][x] = std::min(1.0f, scale * opacity);
    }
  };
  return mips;
}

}  // namespace

MipMap color_mips(const GivenMap& map, const MapBands& bands, const MipChoice& choice) {
  MipMap mips;
  mips.file = file_of(map);
  mips.file.names = channel_names(3);
  mips.file.color_from = bands.working;
  mips.file.color_stored = map.color_space;
  mips.channels = choice.weighted ? 4 : 3;
  mips.first_as_stored = true;
  mips.first = [slot = map.slot](const MipBand& band) {
    return named(band.stored.at(slot).image, channel_names(3));
  };
  mips.energy_of_numbers = true;
  mips.energy_name = choice.weighted ? "linear colour times opacity" : "linear colour";
  mips.energy = [](int width, const float* const* numbers, const float* const*) {
    double sum = 0;
    for (size_t c = 0; c < 3; ++c) sum += sum_of_layer(width, numbers[c]) / 3;
    return sum;
  };
  if (choice.weighted) {
    mips.file.attributes.emplace_back("kiln:weight", "opacity");
    mips.fill = [slot = map.slot](const MipBand& band, int y, float* const* numbers) {
      fill_weighted(band, slot, y, numbers);
    };
    mips.store = [](int, int width, const float* const* numbers, float* const* layers) {
      unweigh(width, numbers, layers);
    };
    return choice.opacity_within ? with_opacity(std::move(mips), map.slot, choice) : mips;
  }
  mips.fill = [slot = map.slot](const MipBand& band, int y, float* const* numbers) {
    for (size_t c = 0; c < 3; ++c) {
      const Plane& plane = plane_of(band.linear, slot, c);
      std::copy_n(plane.row(y), plane.width(), numbers[c]);
    }
  };
  mips.store = [](int, int width, const float* const* numbers, float* const* layers) {
    copy_rows(width, 3, numbers, layers);
  };
  return mips;
}

MipMap number_mips(const GivenMap& map) {
  MipMap mips;
  mips.file = file_of(map);
  mips.channels = static_cast<int>(mips.file.names.size());
  const auto count = mips.file.names.size();
  mips.first = [slot = map.slot, names = mips.file.names](const MipBand& band) {
    return named(band.stored.at(slot).image, names);
  };
  mips.fill = [slot = map.slot, count](const MipBand& band, int y, float* const* numbers) {
    for (size_t c = 0; c < count; ++c) {
      const Plane& plane = plane_of(band.stored, slot, c);
      std::copy_n(plane.row(y), plane.width(), numbers[c]);
    }
  };
  mips.store = [count](int, int width, const float* const* numbers, float* const* layers) {
    copy_rows(width, count, numbers, layers);
  };
  mips.energy_name = mips.file.name;
  mips.energy = [](int width, const float* const*, const float* const* layers) {
    return sum_of_layer(width, layers[0]);
  };
  return mips;
}

// A lobe turned by half a turn is the same lobe, so that directions of twice the angle are
// averaged.
MipMap angle_mips(const GivenMap& map) {
  MipMap mips = number_mips(map);
  if (map.channels != 1) return mips;  // directions already
  constexpr double twice = 4 * pi;     // of whole turns
  mips.channels = 2;
  mips.energy = {};
  mips.fill = [slot = map.slot](const MipBand& band, int y, float* const* numbers) {
    const Plane& plane = plane_of(band.stored, slot, 0);
    const float* turns = plane.row(y);
    for (int x = 0; x < plane.width(); ++x) {
      numbers[0][x] = static_cast<float>(std::cos(twice * turns[x]));
      numbers[1][x] = static_cast<float>(std::sin(twice * turns[x]));
    }
  };
  mips.store = [](int, int width, const float* const* numbers, float* const* layers) {
    for (int x = 0; x < width; ++x) {
      const double turns = std::atan2(numbers[1][x], numbers[0][x]) / twice;
      layers[0][x] = static_cast<float>(turns < 0 ? turns + 0.5 : turns);
    }
  };
  return mips;
}

MipMap opacity_mips(const GivenMap& map, const MipChoice& choice) {
  MipMap mips = number_mips(map);
  if (choice.opacity_scales.empty()) return mips;
  mips.store = [scales = choice.opacity_scales](int level, int width, const float* const* numbers,
                                                float* const* layers) {
    const float scale = scales[static_cast<size_t>(level)];
    for (int x = 0; x < width; ++x) layers[0][x] = std::min(1.0f, scale * numbers[0][x]);
  };
  return mips;
}

MipMap normal_mips(const GivenMap& map, const MipChoice& choice) {
  MipMap mips;
  mips.file = file_of(map);
  mips.channels = 2;
  mips.first = [names = mips.file.names](const MipBand& band) {
    return named(band.stored.at(Slot::Normal).image, names);
  };
  mips.fill = [](const MipBand& band, int y, float* const* numbers) {
    const float *nx = band.normal[0].row(y), *ny = band.normal[1].row(y);
    const float* nz = band.normal[2].row(y);
    for (int i = 0; i < band.normal[0].width(); i += lanes) {
      const W inverse = W(1) / max(at(nz, i), W(least_normal_z));
      store_lanes(numbers[0] + i, W(at(nx, i) * inverse));
      store_lanes(numbers[1] + i, W(at(ny, i) * inverse));
    }
  };
  mips.store = [encoding = NormalEncoding(choice.form->decoding), count = mips.file.names.size()](
                   int, int width, const float* const* numbers, float* const* layers) {
    store_normals(encoding, count, width, numbers, layers);
  };
  const bool directx = choice.form->decoding.convention == NormalConvention::DirectX;
  mips.file.attributes.emplace_back("kiln:normal_convention", directx ? "dx" : "gl");
  return mips;
}

MipMap roughness_mips(const std::string& name, bool gloss, const std::string& type,
                      const MipChoice& choice) {
  MipMap mips = lobe_mips(name, {"Y"}, type, choice);
  mips.first = [gloss](const MipBand& band) {
    Layers image{band.roughness.size(), {}};
    Plane& plane = image.add("Y");
    for (int y = 0; y < plane.height(); ++y) {
      const float* from = band.roughness.row(y);
      float* to = plane.row(y);
      for (int x = 0; x < plane.width(); ++x) to[x] = gloss ? 1.0f - from[x] : from[x];
    }
    return image;
  };
  mips.store = [gloss, filtering = filtering_of(choice)](
                   int, int width, const float* const* numbers, float* const* layers) {
    LobeRow lobes;
    lobes.roughness = layers[0];
    lobes_of_moments(filtering, width, numbers, lobes);
    for (int x = 0; x < width && gloss; ++x) layers[0][x] = 1.0f - layers[0][x];
  };
  mips.energy_name = "alpha^2";
  mips.energy = [gloss](int width, const float* const*, const float* const* layers) {
    if (!gloss) return sum_of_fourth_powers(width, layers[0]);
    double sum = 0;
    for (int x = 0; x < width; ++x) sum += square(square(1.0 - layers[0][x]));
    return sum;
  };
  return mips;
}

MipMap anisotropy_mips(const std::string& type, const MipChoice& choice) {
  MipMap mips = lobe_mips("anisotropy", {"alpha_x", "alpha_y", "angle"}, type, choice);
  const auto store = [filtering = filtering_of(choice)](int, int width, const float* const* numbers,
                                                        float* const* layers) {
    LobeRow lobes;
    lobes.alpha_x = layers[0];
    lobes.alpha_y = layers[1];
    lobes.angle = layers[2];
    lobes_of_moments(filtering, width, numbers, lobes);
  };
  mips.store = store;
  mips.first = [names = mips.file.names](const MipBand& band) {
    Layers image = make_layers(band.roughness.size(), names);
    for (int y = 0; y < band.rows; ++y) {
      const float* r = band.roughness.row(y);
      float *x = image.layers[0].plane.row(y), *other = image.layers[1].plane.row(y);
      for (int i = 0; i < band.roughness.width(); ++i) x[i] = other[i] = r[i] * r[i];
    }
    return image;
  };
  mips.file.attributes.emplace_back(
      "kiln:channels",
      "alpha_x is the greater width, alpha_y the lesser; angle is that of alpha_x, "
      "counter-clockwise from +x with +y up, in half turns");
  return mips;
}

std::vector<float> coverage_scales(Plane opacity, int levels, double threshold) {
  const auto limit = static_cast<float>(threshold);
  double covered = 0;
  for (int y = 0; y < opacity.height(); ++y) {
    const auto row = opacity.texels_of_row(y);
    covered += static_cast<double>(
        std::count_if(row.begin(), row.end(), [&](float v) { return v > limit; }));
  }
  const double share = covered / static_cast<double>(area(opacity.size()));
  std::vector<float> scales(static_cast<size_t>(levels), 1.0f);
  for (int l = 1; l < levels; ++l) {
    opacity = next_level(opacity);
    scales[static_cast<size_t>(l)] = coverage_scale(opacity, share, limit);
  }
  return scales;
}

}  // namespace kiln
