// SPDX-License-Identifier: Apache-2.0
#include "kiln/table/lut.h"

#include <algorithm>
#include <cmath>

#include "kiln/parallel/rows.h"

namespace kiln {
namespace {

using Entries = std::vector<std::vector<double>>;

// A set of points along each axis of a table, in file order.
struct Lattice {
  std::vector<Quantity> quantities;            // x, y, z
  std::vector<std::vector<double>> positions;  // of the quantities

  size_t count() const {
    size_t product = 1;
    for (const auto& axis : positions) product *= axis.size();
    return product;
  }
};

TableGrid grid_of(const Lattice& lattice) {
  TableGrid grid;
  for (size_t a = 0; a < lattice.quantities.size(); ++a) {
    grid.of(lattice.quantities[a]) = lattice.positions[a];
  }
  return grid;
}

// Steps in a channel's own array for one step along each axis of the lattice.
std::vector<size_t> strides_of(const ChannelFacts& channel, const Lattice& lattice) {
  std::vector<size_t> strides(lattice.quantities.size(), 0);
  size_t step = 1;
  for (const Quantity quantity : channel.over) {
    for (size_t a = 0; a < lattice.quantities.size(); ++a) {
      if (lattice.quantities[a] != quantity) continue;
      strides[a] = step;
      step *= lattice.positions[a].size();
    }
  }
  return strides;
}

// A channel's values in the lattice's order: x fastest.
std::vector<double> spread(const std::vector<double>& values, const ChannelFacts& channel,
                           const Lattice& lattice) {
  const std::vector<size_t> strides = strides_of(channel, lattice);
  std::vector<double> placed(lattice.count());
  for (size_t i = 0; i < placed.size(); ++i) {
    size_t rest = i, at = 0;
    for (size_t a = 0; a < strides.size(); ++a) {
      at += rest % lattice.positions[a].size() * strides[a];
      rest /= lattice.positions[a].size();
    }
    placed[i] = values[at];
  }
  return placed;
}

// Fits have no truth to be compared with: without them, their channels stay empty.
enum class Fits { With, Without };

Entries fill_lattice(const TableRecipe& recipe, const Lattice& lattice, LobeCache& lobes,
                     Fits fits) {
  const TableGrid grid = grid_of(lattice);
  TableContext context{recipe.models, grid, lobes};
  Entries entries;
  entries.reserve(recipe.channels.size());
  for (const std::string& name : recipe.channels) {
    const ChannelFacts& channel = find_channel(name);
    const bool wanted = fits == Fits::With || !channel.fitted;
    entries.push_back(wanted ? spread(channel.fill(context), channel, lattice)
                             : std::vector<double>{});
  }
  return entries;
}

std::vector<TableAxis> make_axes(const TableRecipe& recipe) {
  const int counts[] = {recipe.size.width, recipe.size.height, recipe.depth};
  std::vector<TableAxis> axes;
  axes.reserve(recipe.axes.size());
  for (size_t a = 0; a < recipe.axes.size(); ++a) {
    TableAxis axis{find_axis_mapping(recipe.axes[a]), counts[a], {}, {}};
    axis.flipped = a == 1 && recipe.origin == Origin::Bottom;
    axis.coordinates.reserve(axis.count);
    for (int i = 0; i < axis.count; ++i) {
      const int at = axis.flipped ? axis.count - 1 - i : i;
      axis.coordinates.push_back(
          axis.mapping.value(entry_position(at, axis.count, recipe.alignment)));
    }
    axes.push_back(std::move(axis));
  }
  return axes;
}

Lattice lattice_of(const std::vector<TableAxis>& axes) {
  Lattice lattice;
  for (const TableAxis& axis : axes) {
    lattice.quantities.push_back(axis.mapping.quantity);
    lattice.positions.push_back(axis.coordinates);
  }
  return lattice;
}

// Up to `most` of n indices, evenly, first and last among them.
std::vector<int> spread_indices(int n, int most) {
  const int count = std::min(n, most);
  std::vector<int> indices;
  indices.reserve(count);
  for (int k = 0; k < count; ++k) {
    indices.push_back(count > 1 ? static_cast<int>(std::lround(k * (n - 1.0) / (count - 1))) : 0);
  }
  return indices;
}

Quality quality_of(const TableRecipe& recipe) {
  return recipe.exact ? Quality::Exact : Quality::Table;
}

void check_entries(Lut& lut, double floor_mu) {
  const int most = lut.axes.size() > 2 ? 5 : 19;
  Lattice lattice = lattice_of(lut.axes);
  std::vector<std::vector<int>> indices;
  for (size_t a = 0; a < lut.axes.size(); ++a) {
    indices.push_back(spread_indices(lut.axes[a].count, most));
    lattice.positions[a].clear();
    for (const int i : indices[a]) lattice.positions[a].push_back(lut.axes[a].coordinates[i]);
  }
  LobeCache finer_lobes(finer(quality_of(lut.recipe)), floor_mu);
  const Entries truth = fill_lattice(lut.recipe, lattice, finer_lobes, Fits::Without);
  lut.entries_checked = static_cast<int>(lattice.count());
  for (size_t i = 0; i < lattice.count(); ++i) {
    size_t rest = i, at = 0, step = 1;
    for (size_t a = 0; a < indices.size(); ++a) {
      at += step * indices[a][rest % indices[a].size()];
      rest /= indices[a].size();
      step *= lut.axes[a].count;
    }
    for (size_t c = 0; c < truth.size(); ++c) {
      if (truth[c].empty()) continue;
      lut.entry_error = std::max(lut.entry_error, std::abs(lut.entries[c][at] - truth[c][i]));
    }
  }
}

// Probes crowd toward grazing angles, where lookups err most.
std::vector<double> probes_along(const AxisMapping& mapping, int count) {
  std::vector<double> probes;
  probes.reserve(count);
  for (int i = 0; i < count; ++i) {
    const double u = (i + 0.5) / count;
    if (mapping.quantity == Quantity::Mu) {
      probes.push_back(1e-3 + (1 - 1e-3) * u * u);
    } else if (mapping.quantity == Quantity::Roughness) {
      probes.push_back(0.01 + 0.99 * i / (count - 1));
    } else {
      probes.push_back(mapping.value(u));
    }
  }
  return probes;
}

bool is_inner(const Lattice& lattice, const std::vector<double>& point) {
  for (size_t a = 0; a < point.size(); ++a) {
    if (lattice.quantities[a] == Quantity::Mu && point[a] < 0.05) return false;
    if (lattice.quantities[a] == Quantity::Roughness && point[a] < 0.1) return false;
  }
  return true;
}

void check_lookups(Lut& lut, LobeCache& lobes) {
  const int count = lut.axes.size() > 2 ? 12 : 96;
  Lattice lattice = lattice_of(lut.axes);
  for (size_t a = 0; a < lut.axes.size(); ++a) {
    lattice.positions[a] = probes_along(lut.axes[a].mapping, count);
  }
  const Entries truth = fill_lattice(lut.recipe, lattice, lobes, Fits::Without);
  std::vector<double> point(lut.axes.size());
  for (size_t i = 0; i < lattice.count(); ++i) {
    size_t rest = i;
    for (size_t a = 0; a < point.size(); ++a) {
      point[a] = lattice.positions[a][rest % lattice.positions[a].size()];
      rest /= lattice.positions[a].size();
    }
    for (size_t c = 0; c < truth.size(); ++c) {
      if (truth[c].empty()) continue;
      const double error = std::abs(look_up(lut, c, point) - truth[c][i]);
      lut.lookup_error = std::max(lut.lookup_error, error);
      if (is_inner(lattice, point)) {
        lut.lookup_error_inner = std::max(lut.lookup_error_inner, error);
      }
    }
  }
}

double mean_of(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

// Where entries are fitted, how well they fit is found beside them.
void fill_entries(Lut& lut, LobeCache& lobes) {
  const auto& channels = lut.recipe.channels;
  const bool fitted = std::any_of(channels.begin(), channels.end(), [](const std::string& name) {
    return find_channel(name).fitted;
  });
  TableRecipe wanted = lut.recipe;
  if (fitted) wanted.channels.emplace_back("ltc-error");
  lut.entries = fill_lattice(wanted, lattice_of(lut.axes), lobes, Fits::With);
  if (!fitted) return;
  lut.fit_error = mean_of(lut.entries.back());
  lut.entries.pop_back();
}

double least_mu_of(const std::vector<TableAxis>& axes) {
  double least = 1e-3;  // of the probes
  for (const TableAxis& axis : axes) {
    if (axis.mapping.quantity != Quantity::Mu) continue;
    for (const double mu : axis.coordinates) least = std::min(least, mu);
  }
  return std::max(least, least_mu);
}

// Where a coordinate lies among the entries of an axis: the first of two, and how far to the next.
struct Between {
  int first = 0;
  double blend = 0;
};
Between place(const TableAxis& axis, Alignment alignment, double coordinate) {
  double u = axis.mapping.position(coordinate);
  if (axis.flipped) u = 1 - u;
  const double last = axis.count - 1;
  const double at =
      std::clamp(alignment == Alignment::Center ? u * axis.count - 0.5 : u * last, 0.0, last);
  const int first = std::clamp(static_cast<int>(at), 0, std::max(axis.count - 2, 0));
  return {first, at - first};
}

}  // namespace

Lut build_lut(const TableRecipe& recipe) {
  Lut lut;
  lut.recipe = recipe;
  lut.axes = make_axes(recipe);
  const double floor_mu = least_mu_of(lut.axes);
  LobeCache lobes(quality_of(recipe), floor_mu);
  fill_entries(lut, lobes);
  check_entries(lut, floor_mu);
  check_lookups(lut, lobes);
  return lut;
}

double look_up(const Lut& lut, size_t channel, const std::vector<double>& point) {
  const std::vector<double>& entries = lut.entries[channel];
  std::array<Between, 3> at;
  std::array<size_t, 3> step{1, 1, 1};
  for (size_t a = 0; a < lut.axes.size(); ++a) {
    at[a] = place(lut.axes[a], lut.recipe.alignment, point[a]);
    if (a > 0) step[a] = step[a - 1] * lut.axes[a - 1].count;
  }
  double sum = 0;
  for (unsigned corner = 0; corner < 1u << lut.axes.size(); ++corner) {
    double weight = 1;
    size_t index = 0;
    for (size_t a = 0; a < lut.axes.size(); ++a) {
      const bool next = (corner >> a & 1) != 0;
      weight *= next ? at[a].blend : 1 - at[a].blend;
      index += step[a] * (at[a].first + (next ? 1 : 0));
    }
    if (weight != 0) sum += weight * entries[index];
  }
  return sum;
}

std::vector<double> integrate_at(const TableRecipe& recipe, const std::vector<double>& point) {
  Lattice lattice;
  for (size_t a = 0; a < recipe.axes.size(); ++a) {
    lattice.quantities.push_back(find_axis_mapping(recipe.axes[a]).quantity);
    lattice.positions.push_back({point[a]});
  }
  LobeCache lobes(Quality::Exact, least_mu);
  std::vector<double> values;
  for (const auto& channel : fill_lattice(recipe, lattice, lobes, Fits::With))
    values.push_back(channel[0]);
  return values;
}

std::vector<std::string> plane_names(size_t channels) {
  if (channels == 1) return {"Y"};
  const std::vector<std::string> colors = {"R", "G", "B", "A"};
  std::vector<std::string> names;
  for (size_t c = 0; c < channels; ++c) {
    names.push_back(channels <= 4 ? colors[c] : "channel" + std::to_string(c));
  }
  return names;
}

Layers to_image(const Lut& lut) {
  const int width = lut.recipe.size.width;
  const int rows = lut.recipe.size.height * lut.recipe.depth;
  Layers image{{width, rows}, {}};
  const std::vector<std::string> names = plane_names(lut.entries.size());
  for (size_t c = 0; c < lut.entries.size(); ++c) {
    Plane& plane = image.add(names[c]);
    for (int y = 0; y < rows; ++y) {
      const double* row = &lut.entries[c][static_cast<size_t>(y) * width];
      std::transform(row, row + width, plane.row(y),
                     [](double value) { return static_cast<float>(value); });
    }
  }
  return image;
}

}  // namespace kiln
