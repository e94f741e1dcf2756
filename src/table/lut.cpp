// SPDX-License-Identifier: Apache-2.0
#include "kiln/table/lut.h"

#include <algorithm>
#include <numeric>

#include "lattice.h"

namespace kiln {
namespace {

// Entries that are made together: enough for all threads, and a few megabytes.
constexpr long long entries_at_once = 1 << 18;

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

double least_mu_of(const std::vector<TableAxis>& axes) {
  double least = 1e-3;  // of the probes
  for (const TableAxis& axis : axes) {
    if (axis.mapping.quantity != Quantity::Mu) continue;
    for (const double mu : axis.coordinates) least = std::min(least, mu);
  }
  return std::max(least, least_mu);
}

double mean_of(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

std::vector<int> range(int first, int count) {
  std::vector<int> indices(static_cast<size_t>(count));
  std::iota(indices.begin(), indices.end(), first);
  return indices;
}

// Whole slices.
LutIndices slices_from(const std::vector<TableAxis>& axes, int first, int count) {
  LutIndices indices;
  for (size_t a = 0; a < axes.size(); ++a) {
    indices.push_back(a < 2 ? range(0, axes[a].count) : range(first, count));
  }
  return indices;
}

bool runs_over(const ChannelFacts& channel, Quantity quantity) {
  return std::count(channel.over.begin(), channel.over.end(), quantity) > 0;
}

}  // namespace

LutSource::LutSource(const TableRecipe& recipe)
    : recipe_(recipe),
      axes_(make_axes(recipe)),
      whole_(lattice_of(axes_).grid()),
      lobes_(quality_of(recipe), least_mu_of(axes_)) {
  hold();
}

int LutSource::slices() const { return axes_.size() > 2 ? axes_[2].count : 1; }

int LutSource::slices_at_once() const {
  const long long slice = area(recipe_.size);
  return static_cast<int>(std::clamp<long long>(entries_at_once / slice, 1, slices()));
}

bool LutSource::is_held(const ChannelFacts& channel) const {
  const bool whole = axes_.size() < 3 || slices_at_once() == slices();
  return whole || channel.fitted || !runs_over(channel, axes_[2].mapping.quantity);
}

// Where entries are fitted, how well they fit is found beside them.
void LutSource::hold() {
  TableContext context{recipe_.models, whole_, whole_, lobes_};
  bool fitted = false;
  for (const std::string& name : recipe_.channels) {
    const ChannelFacts& channel = find_channel(name);
    held_.push_back(is_held(channel) ? channel.fill(context) : std::vector<double>{});
    fitted = fitted || channel.fitted;
  }
  if (fitted) fit_error_ = mean_of(find_channel("ltc-error").fill(context));
}

// Calls use(channel, values, strides, indices): where the part lies in these values.
template <class Use>
void LutSource::make(const LutIndices& indices, Use&& use) {
  const Lattice all = lattice_of(axes_);
  Lattice part = all;
  for (size_t a = 0; a < axes_.size(); ++a) {
    part.positions[a].clear();
    for (const int i : indices[a]) part.positions[a].push_back(axes_[a].coordinates[i]);
  }
  const TableGrid grid = part.grid();
  TableContext context{recipe_.models, grid, whole_, lobes_};
  for (size_t c = 0; c < recipe_.channels.size(); ++c) {
    const ChannelFacts& channel = find_channel(recipe_.channels[c]);
    if (is_held(channel)) {
      use(c, held_[c], strides_of(channel, all), indices);
    } else {
      use(c, channel.fill(context), strides_of(channel, part), all_indices(part));
    }
  }
}

Layers LutSource::image(int first, int count) {
  const int rows = recipe_.size.height * count;
  Layers image = make_layers({recipe_.size.width, rows}, plane_names(recipe_.channels.size()));
  make(slices_from(axes_, first, count),
       [&](size_t c, const std::vector<double>& values, const std::vector<size_t>& strides,
           const LutIndices& indices) {
         for (int y = 0; y < rows; ++y) {
           copy_row(values, strides, indices, static_cast<size_t>(y), image.layers[c].plane.row(y));
         }
       });
  lobes_.drop_unused();
  return image;
}

LutEntries LutSource::entries(const LutIndices& indices) {
  LutEntries entries(recipe_.channels.size());
  make(indices, [&](size_t c, const std::vector<double>& values, const std::vector<size_t>& strides,
                    const LutIndices& part) { entries[c] = copy_part(values, strides, part); });
  lobes_.keep();
  return entries;
}

LutEntries LutSource::integrals(const std::vector<std::vector<double>>& coordinates) {
  Lattice lattice = lattice_of(axes_);
  lattice.positions = coordinates;
  return fill_lattice(recipe_, lattice, lobes_, Fits::Without);
}

Lut build_lut(const TableRecipe& recipe) {
  LutSource source(recipe);
  const LutErrors errors = errors_of(source);
  return {recipe, source.axes(), source.entries(slices_from(source.axes(), 0, source.slices())),
          errors};
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

}  // namespace kiln
