// SPDX-License-Identifier: Apache-2.0
#include "sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "decoding.h"

namespace kiln::validate {
namespace {

constexpr int most_channels = 8;
constexpr size_t least_curve = 8, longest_curve = 4096;
constexpr int least_side = 4;

Arrangement arrange(int width, int height, int channels, bool planar) {
  const char* order = channels == 1 ? "" : planar ? ", planar" : ", interleaved";
  return {{width, height},
          channels,
          planar,
          channels == 1 ? fmt::format("{} x {}", width, height)
                        : fmt::format("{} x {} x {}{}", width, height, channels, order),
          1};
}

Arrangement arrange_slices(int width, int height, int depth, int channels) {
  return {{width, height * depth},
          channels,
          false,
          fmt::format("{} x {} x {}{}", width, height, depth,
                      channels == 1 ? "" : fmt::format(" x {}, interleaved", channels)),
          depth};
}

bool tableau(long long width, long long height) {
  return width >= least_side && height >= least_side;
}

// Lengths of the sides of w * h = n, square or up to 4 : 1.
std::vector<Size> sides(size_t n) {
  std::vector<Size> found;
  for (const int aspect : {1, 2, 4}) {
    const auto side = static_cast<long long>(std::llround(std::sqrt(double(n) / aspect)));
    if (side * side * aspect != static_cast<long long>(n)) continue;
    if (!tableau(side, side)) continue;
    const int a = static_cast<int>(side), b = a * aspect;
    found.push_back({b, a});
    if (aspect > 1) found.push_back({a, b});
  }
  return found;
}

std::vector<Arrangement> arrangements_of_length(size_t n) {
  std::vector<Arrangement> found;
  for (int channels = 1; channels <= 4; ++channels) {
    if (n % channels != 0) continue;
    for (const Size size : sides(n / channels)) {
      found.push_back(arrange(size.width, size.height, channels, false));
      if (channels > 1) found.push_back(arrange(size.width, size.height, channels, true));
    }
  }
  return found;
}

bool is_curve(const std::vector<int>& shape, size_t n) {
  return n >= least_curve && n <= longest_curve &&
         (shape.empty() || std::count(shape.begin(), shape.end(), static_cast<int>(n)) == 1);
}

std::vector<Arrangement> arrangements_of_shape(const std::vector<int>& shape) {
  std::vector<Arrangement> found;
  if (shape.size() == 2 && tableau(shape[1], shape[0])) {
    found.push_back(arrange(shape[1], shape[0], 1, false));
  }
  if (shape.size() == 2 && shape[1] <= 4 && shape[0] >= least_side * least_side) {
    for (const Size size : sides(shape[0])) {
      found.push_back(arrange(size.width, size.height, shape[1], false));
    }
  }
  if (shape.size() == 3 && shape[2] <= most_channels && tableau(shape[1], shape[0])) {
    found.push_back(arrange(shape[1], shape[0], shape[2], false));
  }
  if (shape.size() == 3 && shape[0] <= 4 && tableau(shape[2], shape[1])) {
    found.push_back(arrange(shape[2], shape[1], shape[0], true));
  }
  if (shape.size() == 3 && (shape[0] == 1 || shape[1] == 1) && shape[2] <= 4) {
    found.push_back(arrange(shape[0] * shape[1], 1, shape[2], false));
  }
  return found;
}

// Lines of a text may be rows, or broken anywhere.
bool has_shape(const NumberArray& array) {
  using Stored = NumberArray::Stored;
  const bool text = array.stored == Stored::Integer || array.stored == Stored::Decimal;
  return array.shape.size() > 2 || (array.shape.size() == 2 && !text);
}

// Those that are not there yet.
void append(std::vector<Arrangement> more, std::vector<Arrangement>& found) {
  for (Arrangement& one : more) {
    const bool known = std::any_of(found.begin(), found.end(), [&](const Arrangement& other) {
      return other.words == one.words;
    });
    if (!known) found.push_back(std::move(one));
  }
}

std::vector<Arrangement> arrangements(const NumberArray& array) {
  const size_t n = array.values.size();
  std::vector<Arrangement> found = arrangements_of_shape(array.shape);
  if (!has_shape(array)) append(arrangements_of_length(n), found);
  if (is_curve(array.shape, n)) found.push_back(arrange(static_cast<int>(n), 1, 1, false));
  std::erase_if(found, [n](const Arrangement& one) {
    return static_cast<size_t>(area(one.size)) * one.channels > n;
  });
  return found;
}

// Lists of 8 to 64 numbers cubed, of up to four channels.
std::vector<Arrangement> cubes_of_length(size_t n) {
  std::vector<Arrangement> found;
  for (int channels = 1; channels <= 4; ++channels) {
    for (int side = 8; side <= 64; ++side) {
      const size_t count = static_cast<size_t>(side) * side * side * channels;
      if (count == n) found.push_back(arrange_slices(side, side, side, channels));
    }
  }
  return found;
}

std::vector<Arrangement> solid_arrangements(const NumberArray& array) {
  const std::vector<int>& s = array.shape;
  const auto product =
      std::accumulate(s.begin(), s.end(), size_t{1}, [](size_t all, int one) { return all * one; });
  if (!s.empty() && product != array.values.size()) return {};
  if (!has_shape(array)) return cubes_of_length(array.values.size());
  if (s.size() == 4 && s[3] <= 4 && s[0] > 1 && tableau(s[1], s[2])) {
    return {arrange_slices(s[2], s[1], s[0], s[3])};
  }
  if (s.size() == 3 && s[2] > most_channels && tableau(s[1], s[0])) {
    return {arrange_slices(s[2], s[1], s[0], 1)};
  }
  const bool plane = s.size() == 2 || (s.size() == 3 && s[2] <= 4);
  const int channels = s.size() == 3 ? s[2] : 1;
  if (plane && s[0] > s[1] && s[0] % s[1] == 0 && s[1] >= least_side) {
    return {arrange_slices(s[1], s[1], s[0] / s[1], channels)};
  }
  return {};
}

std::string channel_name(const NumberArray& array, int c, int count) {
  if (static_cast<int>(array.channels.size()) == count) return array.channels[c];
  return std::to_string(c);
}

using Shared = std::shared_ptr<const NumberArray>;

Sheet make_sheet(const Shared& array, const Arrangement& arrangement, const Decoding& decoding) {
  Sheet sheet{array, arrangement, decoding, {}};
  const bool rgbd = decoding.kind == Decoding::Kind::Rgbd;
  const int count = rgbd ? 3 : arrangement.channels;
  for (int c = 0; c < count; ++c) {
    sheet.channels.push_back(channel_name(*array, c, arrangement.channels));
  }
  return sheet;
}

// Mean squared difference between neighbours over the variance: small for tables, about 2 for noise
// and for a wrong arrangement.
double unevenness(const Sheet& sheet) {
  const std::vector<int> columns = spread_indices(sheet.size().width, 128);
  const std::vector<int> rows = spread_indices(sheet.size().height, 128);
  const int w = static_cast<int>(columns.size()), h = static_cast<int>(rows.size());
  double worst = 0;
  for (const std::vector<double>& v : values_at(sheet, columns, rows)) {
    const double spread = variance(v);
    if (spread < 1e-12) continue;
    double across = 0, down = 0;
    for (int i = 0; i < w * h; ++i) {
      if (i % w != 0) across += (v[i] - v[i - 1]) * (v[i] - v[i - 1]);
      if (i >= w) down += (v[i] - v[i - w]) * (v[i] - v[i - w]);
    }
    worst = std::max(worst, std::max(across, down) / (spread * w * h));
  }
  return worst;
}

// Wrong arrangements tear neighbours apart: of many only the most even are kept.
void keep_the_most_even(std::vector<Sheet>& sheets, size_t most) {
  if (sheets.size() <= most) return;
  std::vector<std::pair<double, Sheet>> ranked;
  for (Sheet& sheet : sheets) {
    const double score = unevenness(sheet);
    ranked.emplace_back(score, std::move(sheet));
  }
  std::stable_sort(ranked.begin(), ranked.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  sheets.clear();
  for (size_t i = 0; i < most; ++i) sheets.push_back(std::move(ranked[i].second));
}

void append_sheets(const Shared& array, std::vector<Sheet>& all) {
  const bool told = has_shape(*array);
  for (const Decoding& decoding : decodings(*array)) {
    std::vector<Sheet> sheets;
    for (const Arrangement& arrangement : arrangements(*array)) {
      if (decoding.channels != 0 && decoding.channels != arrangement.channels) continue;
      sheets.push_back(make_sheet(array, arrangement, decoding));
    }
    if (!told) keep_the_most_even(sheets, 3);
    for (Sheet& sheet : sheets) all.push_back(std::move(sheet));
  }
}

// One array a channel: arrays of one shape and one channel each.
void append_joined(const std::vector<NumberArray>& arrays, std::vector<Sheet>& all) {
  if (arrays.size() < 2 || arrays.size() > 4) return;
  for (const NumberArray& array : arrays) {
    if (array.shape != arrays[0].shape || array.stored != arrays[0].stored) return;
    if (array.values.size() != arrays[0].values.size()) return;
  }
  auto joined = std::make_shared<NumberArray>(arrays[0]);
  joined->values.clear();
  joined->channels.clear();
  for (const NumberArray& array : arrays) {
    if (&array != arrays.data()) joined->name += ", " + array.name;
    joined->channels.push_back(array.name);
    joined->values.insert(joined->values.end(), array.values.begin(), array.values.end());
  }
  const int count = static_cast<int>(arrays.size());
  for (const Arrangement& one : arrangements(arrays[0])) {
    if (one.channels != 1 || one.size.height == 1) continue;
    const Arrangement together = arrange(one.size.width, one.size.height, count, true);
    for (const Decoding& decoding : decodings(*joined)) {
      if (decoding.channels == 0) all.push_back(make_sheet(joined, together, decoding));
    }
  }
}

}  // namespace

double variance(const std::vector<double>& values) {
  double sum = 0, squares = 0;
  for (const double value : values) sum += value;
  const double mean = sum / static_cast<double>(values.size());
  for (const double value : values) squares += (value - mean) * (value - mean);
  return squares / static_cast<double>(values.size());
}

std::vector<int> spread_indices(int n, int most) {
  const int count = std::min(n, most);
  std::vector<int> indices(count);
  for (int k = 0; k < (count + 1) / 2; ++k) {
    const double place = count > 1 ? static_cast<double>(k) * (n - 1) / (count - 1) : 0;
    indices[k] = static_cast<int>(std::lround(place));
    indices[count - 1 - k] = n - 1 - indices[k];
  }
  return indices;
}

Values values_at(const Sheet& sheet, const std::vector<int>& columns,
                 const std::vector<int>& rows) {
  Values values(sheet.channels.size());
  for (auto& channel : values) channel.reserve(columns.size() * rows.size());
  std::vector<double> entry(sheet.arrangement.channels);
  for (const int y : rows) {
    for (const int x : columns) {
      const size_t i = static_cast<size_t>(y) * sheet.size().width + x;
      for (int c = 0; c < sheet.arrangement.channels; ++c) {
        entry[c] = sheet.array->values[sheet.arrangement.at(c, i)];
      }
      decode(sheet.decoding, entry);
      for (size_t c = 0; c < values.size(); ++c) values[c].push_back(entry[c]);
    }
  }
  return values;
}

std::vector<Sheet> joined_sheets(const std::vector<NumberArray>& arrays) {
  std::vector<Sheet> all;
  append_joined(arrays, all);
  return all;
}

std::vector<Sheet> solid_sheets(const std::vector<NumberArray>& arrays) {
  std::vector<Sheet> all;
  for (const NumberArray& array : arrays) {
    const auto shared = std::make_shared<NumberArray>(array);
    for (const Arrangement& arrangement : solid_arrangements(array)) {
      for (const Decoding& decoding : decodings(array)) {
        if (decoding.channels != 0) continue;
        all.push_back(make_sheet(shared, arrangement, decoding));
      }
    }
  }
  return all;
}

std::vector<Sheet> possible_sheets(const std::vector<NumberArray>& arrays) {
  std::vector<Sheet> all;
  for (const NumberArray& array : arrays) {
    append_sheets(std::make_shared<NumberArray>(array), all);
  }
  return all;
}

}  // namespace kiln::validate
