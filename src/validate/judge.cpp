// SPDX-License-Identifier: Apache-2.0
#include "judge.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace kiln::validate {
namespace {

// What sampled and coarsely stored tables of engines err by, and what wrong lobes never reach.
constexpr double greatest_rms = 0.02;
constexpr double good_rms = 0.006;
constexpr double least_unexplained = 0.03;  // share of the variance
constexpr double clear_ratio = 1.5;
constexpr double curve_rms = 0.003;

std::string lobe_words(const Lobe& lobe) {
  const bool two_names = lobe.masking == "hammon";  // and the same formula
  return fmt::format("{} with {} masking", lobe.distribution,
                     two_names ? "hammon (unreal-joint)" : lobe.masking);
}

std::string table_class(const std::vector<ChannelFit>& fits, bool curve) {
  int specular = 0, sheen = 0, diffuse = 0;
  for (const ChannelFit& fit : fits) {
    if (fit.constant) continue;
    if (fit.model < 0)
      ++diffuse;
    else if (tried_lobes()[fit.model].sheen)
      ++sheen;
    else
      ++specular;
  }
  if (curve) return "average-albedo";
  if (specular > 1) return "split-sum";
  if (specular == 1) return "directional-albedo";
  return sheen > 0 ? "sheen" : "diffuse";
}

std::vector<ChannelMatch> channel_matches(const Sheet& sheet, const Comparison& comparison,
                                          const std::vector<ChannelErrors>& errors) {
  std::vector<ChannelMatch> matches;
  for (size_t c = 0; c < errors.size(); ++c) {
    const ChannelFit& fit = comparison.fits[c];
    ChannelMatch match{sheet.channels[c], "unknown",       "",          "", errors[c].greatest,
                       errors[c].rms,     errors[c].known, fit.constant};
    if (fit.constant) match.quantity = fmt::format("constant {:.6g}", fit.level);
    if (!fit.constant && errors[c].known) {
      match.quantity = words(fit.meaning);
      if (sheet.is_curve()) match.quantity = "average of " + match.quantity;
      if (fit.model >= 0) {
        match.distribution = tried_lobes()[fit.model].lobe.distribution;
        match.masking = tried_lobes()[fit.model].lobe.masking;
      }
    }
    matches.push_back(std::move(match));
  }
  return matches;
}

// "R = scale, G = bias of ggx with smith-correlated masking"
std::string channel_words(const Match& match) {
  std::string text, lobe;
  for (const ChannelMatch& channel : match.channels) {
    const std::string own =
        channel.distribution.empty() ? "" : lobe_words({channel.distribution, channel.masking, 0});
    if (!lobe.empty() && own != lobe) text += " of " + lobe;
    if (!text.empty()) text += ", ";
    text += channel.channel + " = " + channel.quantity;
    lobe = own;
  }
  return lobe.empty() ? text : text + " of " + lobe;
}

void locate(const Sheet& sheet, const Candidate& candidate, const Comparison& comparison,
            const std::vector<ChannelErrors>& errors, Match& match) {
  const size_t count = comparison.reading.mus.size();
  double squares = 0;
  int known = 0;
  for (size_t c = 0; c < errors.size(); ++c) {
    if (!errors[c].known || comparison.fits[c].constant) continue;
    squares += errors[c].rms * errors[c].rms;
    ++known;
    if (known > 1 && errors[c].greatest <= match.max_error) continue;
    const size_t i = errors[c].worst % count, j = errors[c].worst / count;
    match.max_error = errors[c].greatest;
    match.mu = comparison.reading.mus[i];
    match.roughness = std::sqrt(comparison.reading.alphas[j]);
    match.x =
        candidate.axes.transposed ? comparison.places.widths[j] : comparison.places.cosines[i];
    match.y =
        candidate.axes.transposed ? comparison.places.cosines[i] : comparison.places.widths[j];
    match.channel = sheet.channels[c];
  }
  match.rms_error = known > 0 ? std::sqrt(squares / known) : 0;
}

}  // namespace

std::vector<ChannelErrors> errors_of(const Comparison& comparison) {
  std::vector<ChannelErrors> all;
  for (size_t c = 0; c < comparison.exact.size(); ++c) {
    const std::vector<double>&stored = comparison.reading.values[c], &exact = comparison.exact[c];
    ChannelErrors errors;
    errors.rms = comparison.fits[c].rms;
    errors.spread = std::sqrt(variance(stored));
    for (size_t i = 0; i < stored.size(); ++i) {
      const double error = std::abs(stored[i] - exact[i]);
      if (error <= errors.greatest) continue;
      errors.greatest = error;
      errors.worst = i;
    }
    errors.known = comparison.fits[c].constant ||
                   (errors.rms <= greatest_rms &&
                    errors.rms * errors.rms <= least_unexplained * errors.spread * errors.spread);
    all.push_back(errors);
  }
  return all;
}

double rms_of_known(const std::vector<ChannelErrors>& errors) {
  double squares = 0;
  int known = 0;
  for (const ChannelErrors& one : errors) {
    if (!one.known || one.spread < 1e-6) continue;
    squares += one.rms * one.rms;
    ++known;
  }
  return known > 0 ? std::sqrt(squares / known) : 1;
}

bool acceptable(const Sheet& sheet, const std::vector<ChannelErrors>& errors, double ratio) {
  bool all_known = true, any_known = false;
  for (const ChannelErrors& one : errors) {
    if (one.spread < 1e-6) continue;
    all_known = all_known && one.known;
    any_known = any_known || one.known;
  }
  if (!any_known) return false;
  const double rms = rms_of_known(errors);
  if (sheet.is_curve()) return all_known && rms <= curve_rms + sheet.decoding.step / 2;
  if (!all_known) return rms <= good_rms || (rms <= 2 * good_rms && ratio >= 2 * clear_ratio);
  return rms <= good_rms || ratio >= clear_ratio;
}

double ratio_between(const std::vector<ChannelErrors>& best, const Candidate& best_candidate,
                     const Candidate& other) {
  if (other.fits.size() != best_candidate.fits.size()) {
    return other.score / std::max(best_candidate.score, 1e-12);
  }
  double squares = 0, own = 0;
  for (size_t c = 0; c < best.size(); ++c) {
    if (!best[c].known || best_candidate.fits[c].constant) continue;
    squares += other.fits[c].rms * other.fits[c].rms;
    own += best_candidate.fits[c].rms * best_candidate.fits[c].rms;
  }
  return std::sqrt(squares / std::max(own, 1e-24));
}

Match describe(const Sheet& sheet, const Candidate& candidate, const Comparison& comparison,
               const std::vector<ChannelErrors>& named) {
  std::vector<ChannelErrors> errors = errors_of(comparison);
  for (size_t c = 0; c < errors.size() && c < named.size(); ++c) {
    errors[c].known = errors[c].known || named[c].known;
  }
  Match match;
  match.array = sheet.array->name;
  match.arrangement = sheet.arrangement.words;
  match.decoding = sheet.decoding.words;
  match.table_class = table_class(comparison.fits, sheet.is_curve());
  match.axes = candidate.axes;
  match.channels = channel_matches(sheet, comparison, errors);
  const std::string axes = sheet.is_curve()
                               ? fmt::format("x = {}; entries at {}", words(width_axis(match.axes)),
                                             words(match.axes.width_alignment))
                               : words(match.axes);
  match.convention = fmt::format("{}; {}; {}", channel_words(match), axes, match.decoding);
  locate(sheet, candidate, comparison, errors, match);
  return match;
}

Layers error_layers(const Sheet& sheet, const Candidate& candidate, const Comparison& comparison) {
  const bool transposed = candidate.axes.transposed;
  const int count = static_cast<int>(comparison.reading.mus.size());
  const int rows = static_cast<int>(comparison.reading.alphas.size());
  Layers layers{transposed ? Size{rows, count} : Size{count, rows}, {}};
  const std::vector<ChannelErrors> errors = errors_of(comparison);
  for (size_t c = 0; c < errors.size(); ++c) {
    if (!errors[c].known || comparison.fits[c].constant) continue;
    Plane& plane = layers.add("error." + sheet.channels[c]);
    for (int j = 0; j < rows; ++j) {
      for (int i = 0; i < count; ++i) {
        const size_t at = static_cast<size_t>(j) * count + i;
        const double error = comparison.reading.values[c][at] - comparison.exact[c][at];
        plane.at(transposed ? j : i, transposed ? i : j) = static_cast<float>(error);
      }
    }
  }
  return layers;
}

}  // namespace kiln::validate
