// SPDX-License-Identifier: Apache-2.0
#include "kiln/material/normal_survey.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "kiln/core/error.h"

namespace kiln {

NormalSurvey::NormalSurvey(const SlotMap& map, const WorkflowSettings& settings, bool has_height,
                           bool may_be_signed)
    : source_(map.source),
      named_(map.convention),
      settings_(settings),
      has_height_(has_height),
      may_be_signed_(may_be_signed) {}

bool NormalSurvey::asks_for_convention() const {
  return settings_.normal == NormalConvention::Auto && named_ == NormalConvention::Auto;
}

void NormalSurvey::add(const Layers& normal, const Plane* height) {
  has_third_ = normal.layers.size() > 2 && normal.layers[2].name != "A";
  for (size_t c = 0; c < std::min<size_t>(3, normal.layers.size()); ++c) {
    for (int y = 0; y < normal.size.height; ++y) {
      for (const float value : normal.layers[c].plane.texels_of_row(y)) {
        extremes_[c].min = std::min(extremes_[c].min, value);
        extremes_[c].max = std::max(extremes_[c].max, value);
      }
    }
  }
  texels_ += area(normal.size);
  const DecodedNormals decoded =
      with_context("normal " + source_, [&] { return decode_normals(normal, decoding()); });
  if (!asks_for_convention()) return;
  if (height != nullptr) evidence_.add(decoded.normal, *height);
  evidence_.add(decoded.normal);
}

// As OpenGL, by what was seen so far.
NormalDecoding NormalSurvey::decoding() const {
  constexpr float ringing = -0.05f;  // a little of it below zero is no sign of signed components
  NormalDecoding decoding;
  decoding.zero = settings_.normal_zero;
  decoding.range = settings_.normal_range;
  if (decoding.range == NormalRange::Auto) {
    const bool negative = std::min(extremes_[0].min, extremes_[1].min) < ringing;
    decoding.range = negative ? NormalRange::Signed : NormalRange::Unsigned;
  }
  const bool flat = extremes_[0].constant() && extremes_[1].constant();
  const bool two = !has_third_ || (extremes_[2].constant() && !flat);
  decoding.layout = two ? NormalLayout::TwoChannel : NormalLayout::ThreeChannel;
  return decoding;
}

bool NormalSurvey::is_open() const {
  if (may_be_signed_ && settings_.normal_range == NormalRange::Auto) return true;
  if (has_third_ && extremes_[0].constant() && extremes_[1].constant()) return true;
  if (!asks_for_convention()) return false;
  const ConventionGuess guess = has_height_ ? evidence_.by_height() : evidence_.by_slopes();
  return texels_ < enough_texels || guess.convention == NormalConvention::Auto;
}

NormalForm NormalSurvey::form() const {
  NormalForm form{decoding(), {}, {}};
  const auto told = [&](NormalConvention convention, const std::string& why) {
    form.decoding.convention = convention;
    form.notes.push_back(fmt::format("normal: {}, {}", convention_text(convention), why));
    return form;
  };
  if (form.decoding.layout == NormalLayout::TwoChannel) {
    form.notes.emplace_back("normal: two channels, z rebuilt from x and y");
  }
  if (form.decoding.range == NormalRange::Signed) {
    form.notes.emplace_back("normal: stored as [-1, 1]");
  }
  if (settings_.normal != NormalConvention::Auto) return told(settings_.normal, "as stated");
  if (named_ != NormalConvention::Auto) {
    return told(named_, "as its name or its naming scheme says");
  }
  if (has_height_) {
    const ConventionGuess guess = evidence_.by_height();
    if (guess.convention != NormalConvention::Auto) {
      return told(guess.convention, "by the height map: " + guess.reason);
    }
    form.notes.push_back("normal: the height map does not tell the convention: " + guess.reason);
  }
  const ConventionGuess guess = evidence_.by_slopes();
  const std::string hint =
      guess.convention == NormalConvention::Auto
          ? std::string("its slopes do not tell")
          : fmt::format("its slopes suggest {}", convention_text(guess.convention));
  form.warnings.push_back(
      fmt::format("normal: neither the name {} nor a height map tells OpenGL from DirectX, read as "
                  "OpenGL; {} ({})",
                  source_, hint, guess.reason));
  form.decoding.convention = NormalConvention::OpenGl;
  return form;
}

}  // namespace kiln
