// SPDX-License-Identifier: Apache-2.0
#include "kiln/image/mip_levels.h"

#include <algorithm>
#include <utility>

#include "kiln/parallel/rows.h"

namespace kiln {
namespace {

constexpr int most_chunks = 16;     // of rows that one thread makes, per band
constexpr int rows_of_a_chunk = 4;  // at least
constexpr int most_taps = 3;

int halved(int n) { return std::max(1, n / 2); }

bool is_odd(int n) { return n > 1 && n % 2 == 1; }

void average_pairs(const float* row, int count, float* to) {
  for (int x = 0; x < count; ++x) to[x] = 0.5f * (row[2 * x] + row[2 * x + 1]);
}

// The commonest of all: two by two.
void average_squares(const float* upper, const float* lower, int count, float* to) {
  for (int x = 0; x < count; ++x) {
    const float even = upper[2 * x] + lower[2 * x];
    const float odd = upper[2 * x + 1] + lower[2 * x + 1];
    to[x] = 0.25f * (even + odd);
  }
}

void average_threes(const float* row, const std::vector<float>& left,
                    const std::vector<float>& right, float* to) {
  const auto count = static_cast<int>(left.size());
  const float middle = static_cast<float>(count) / static_cast<float>(2 * count + 1);
  for (int x = 0; x < count; ++x) {
    to[x] = left[x] * row[2 * x] + middle * row[2 * x + 1] + right[x] * row[2 * x + 2];
  }
}

}  // namespace

Size next_level(Size size) { return {halved(size.width), halved(size.height)}; }

std::vector<Size> level_sizes(Size size, int most) {
  std::vector<Size> sizes{size};
  while (sizes.back() != Size{1, 1} && static_cast<int>(sizes.size()) != most) {
    sizes.push_back(next_level(sizes.back()));
  }
  return sizes;
}

AreaHalver::AreaHalver(Size from, int channels)
    : from_(from), to_(next_level(from)), channels_(channels) {
  if (is_odd(from.width)) {
    const auto all = static_cast<float>(from.width);
    for (int x = 0; x < to_.width; ++x) {
      left_.push_back(static_cast<float>(to_.width - x) / all);
      right_.push_back(static_cast<float>(x + 1) / all);
    }
  }
}

AreaHalver::Footprint AreaHalver::rows_of(int y) const {
  if (from_.height == 1) return {0, 1, {1.0f}};
  if (!is_odd(from_.height)) return {2 * y, 2, {0.5f, 0.5f}};
  const auto all = static_cast<float>(from_.height);
  return {2 * y, 3, {(to_.height - y) / all, to_.height / all, (y + 1) / all}};
}

int AreaHalver::complete_rows() const {
  int complete = made_;
  while (complete < to_.height) {
    const Footprint next = rows_of(complete);
    if (next.first + next.count > taken_) break;
    ++complete;
  }
  return complete;
}

LevelRows AreaHalver::add(int rows, const FillRow& fill) {
  taken_ += rows;
  LevelRows made;
  made.first = made_;
  const int count = complete_rows() - made_;
  if (count > 0) {
    for (int c = 0; c < channels_; ++c) made.planes.emplace_back(Size{to_.width, count});
    const int chunks = std::clamp(count / rows_of_a_chunk, 1, most_chunks);
    if (static_cast<int>(scratch_.size()) < chunks) scratch_.resize(chunks);
    for_rows(chunks, [&](int chunk) { make_rows(made, fill, chunk, chunks); });
    made_ += count;
  }
  keep_rest(fill);
  return made;
}

void AreaHalver::make_rows(LevelRows& made, const FillRow& fill, int chunk, int chunks) {
  const size_t stride = Plane({from_.width, 0}).stride();
  std::vector<float>& scratch = scratch_[chunk];
  scratch.resize(stride * (static_cast<size_t>(channels_) * most_taps + 1));
  const auto row_at = [&](int tap, int c) {
    return scratch.data() + stride * static_cast<size_t>(tap * channels_ + c);
  };
  std::vector<float*> filled(channels_), rows(most_taps + 1);
  rows[most_taps] = row_at(most_taps, 0);
  const int count = made.rows();
  for (int i = count * chunk / chunks; i < count * (chunk + 1) / chunks; ++i) {
    const Footprint footprint = rows_of(made.first + i);
    for (int tap = 0; tap < footprint.count; ++tap) {
      const int y = footprint.first + tap;
      for (int c = 0; c < channels_; ++c) filled[c] = row_at(tap, c);
      if (y >= kept_first_ + kept_rows_) fill(y, filled.data());
    }
    for (int c = 0; c < channels_; ++c) {
      for (int tap = 0; tap < footprint.count; ++tap) {
        const int y = footprint.first + tap;
        const bool kept = y < kept_first_ + kept_rows_;
        rows[tap] = kept ? kept_[c].row(y - kept_first_) : row_at(tap, c);
      }
      combine(rows, footprint, made.planes[c].row(i));
    }
  }
}

// Down first, then across; the last of `rows` is free to write to.
void AreaHalver::combine(const std::vector<float*>& rows, const Footprint& footprint,
                         float* to) const {
  if (footprint.count == 2 && left_.empty() && from_.width > 1) {
    return average_squares(rows[0], rows[1], to_.width, to);
  }
  const float* down = rows[0];
  if (footprint.count > 1) {
    float* sum = rows[most_taps];
    const bool three = footprint.count == 3;
    const float* third = three ? rows[2] : rows[0];
    const float weight = three ? footprint.weights[2] : 0.0f;
    for (int x = 0; x < from_.width; ++x) {
      sum[x] =
          footprint.weights[0] * rows[0][x] + footprint.weights[1] * rows[1][x] + weight * third[x];
    }
    down = sum;
  }
  if (from_.width == 1) {
    to[0] = down[0];
  } else if (left_.empty()) {
    average_pairs(down, to_.width, to);
  } else {
    average_threes(down, left_, right_, to);
  }
}

// Rows that an output row sees which is not complete yet.
void AreaHalver::keep_rest(const FillRow& fill) {
  const int first = made_ < to_.height ? rows_of(made_).first : from_.height;
  const int rows = std::max(0, taken_ - first);
  std::vector<Plane> kept;
  for (int c = 0; c < channels_ && rows > 0; ++c) kept.emplace_back(Size{from_.width, rows});
  std::vector<float*> filled(channels_);
  for (int i = 0; i < rows; ++i) {
    const int y = first + i;
    const bool had = y < kept_first_ + kept_rows_;
    for (int c = 0; c < channels_; ++c) {
      filled[c] = kept[c].row(i);
      if (had) std::copy_n(kept_[c].row(y - kept_first_), from_.width, filled[c]);
    }
    if (!had) fill(y, filled.data());
  }
  kept_ = std::move(kept);
  kept_first_ = first;
  kept_rows_ = rows;
}

MipCascade::MipCascade(const std::vector<Size>& sizes, int channels) {
  for (size_t l = 0; l + 1 < sizes.size(); ++l) halvers_.emplace_back(sizes[l], channels);
}

std::vector<LevelRows> MipCascade::add(int rows, const FillRow& fill) {
  std::vector<LevelRows> all;
  for (size_t l = 0; l < halvers_.size(); ++l) {
    if (l == 0) {
      all.push_back(halvers_[l].add(rows, fill));
    } else {
      const LevelRows& above = all[l - 1];
      all.push_back(halvers_[l].add(above.rows(), [&](int y, float* const* channels) {
        for (size_t c = 0; c < above.planes.size(); ++c) {
          const std::span<const float> row = above.planes[c].texels_of_row(y - above.first);
          std::copy(row.begin(), row.end(), channels[c]);
        }
      }));
    }
    all.back().level = static_cast<int>(l) + 1;
    if (all.back().rows() == 0) break;
  }
  std::erase_if(all, [](const LevelRows& made) { return made.rows() == 0; });
  return all;
}

Plane next_level(const Plane& plane) {
  AreaHalver halver(plane.size(), 1);
  LevelRows made = halver.add(plane.height(), [&](int y, float* const* channels) {
    const std::span<const float> row = plane.texels_of_row(y);
    std::copy(row.begin(), row.end(), channels[0]);
  });
  return std::move(made.planes.front());
}

}  // namespace kiln
