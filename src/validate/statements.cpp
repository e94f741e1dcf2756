// SPDX-License-Identifier: Apache-2.0
#include "statements.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace kiln::validate {
namespace {

constexpr int entries_compared = 64;

// The greatest error if the axes were these.
double greatest_error(const Finding& finding, const TableAxes& axes) {
  Candidate other = finding.candidate;
  other.axes = axes;
  const Comparison comparison = compare(finding.sheet, other, entries_compared);
  const std::vector<ChannelErrors> errors = errors_of(comparison);
  double greatest = 0;
  for (size_t c = 0; c < errors.size(); ++c) {
    const ChannelMatch& channel = finding.match.channels[c];
    if (channel.known && !channel.constant) greatest = std::max(greatest, errors[c].greatest);
  }
  return greatest;
}

// What a shifted alignment does to entries, in words, and the alignment it is a shift of.
struct Shift {
  Placement from;
  std::string words;  // with {line}: "row", {what}: "roughness", {more}: "greater"
};

Shift shift_of(const Placement& placement) {
  const bool up = placement.offset > (placement.nodes ? 0 : 0.5);
  const double steps = std::abs(placement.offset - (placement.nodes ? 0 : 0.5));
  const Placement from = placement.nodes ? nodes : centres;
  const char* whole =
      up ? "{0}s hold the {1} of the next {0}" : "{0}s hold the {1} of the previous {0}";
  const char* half = up ? "{0}s hold the {1} half a {0} above their centres"
                        : "{0}s hold the {1} half a {0} below their centres";
  return {from, steps == 1 ? whole : half};
}

void state_shift(const Finding& finding, bool of_cosines, std::vector<std::string>& statements) {
  const TableAxes& axes = finding.candidate.axes;
  const Placement& placement = of_cosines ? axes.cosine_alignment : axes.width_alignment;
  if (plain(placement)) return;
  const Shift shift = shift_of(placement);
  TableAxes declared = axes;
  (of_cosines ? declared.cosine_alignment : declared.width_alignment) = shift.from;
  const std::string line = finding.sheet.is_curve()        ? "entry"
                           : of_cosines == axes.transposed ? "row"
                                                           : "column";
  const bool reversed = of_cosines ? axes.cosine_reversed : axes.width_reversed;
  const std::string what = of_cosines                       ? "n.v"
                           : axes.width == WidthAxis::Alpha ? "alpha"
                                                            : "roughness";
  statements.push_back(fmt::format(fmt::runtime(shift.words), line, what) +
                       (reversed ? fmt::format(" toward greater {}", what) : std::string()) +
                       fmt::format(": greatest error {:.2g} at the {}, {:.2g} where they are",
                                   greatest_error(finding, declared), words(shift.from),
                                   finding.match.max_error));
}

void state_encodings(const Finding& finding, std::vector<std::string>& statements) {
  if (finding.sheet.decoding.kind == Decoding::Kind::Srgb) {
    statements.push_back(
        "values are sRGB-encoded: a reader that takes them as numbers errs by up to 0.28");
  }
  if (finding.candidate.axes.width == WidthAxis::FourthRoot) {
    statements.push_back("roughness is squared once too often: alpha is its fourth power");
  }
  int scale = -1, bias = -1;
  for (size_t c = 0; c < finding.match.channels.size(); ++c) {
    const ChannelMatch& channel = finding.match.channels[c];
    if (channel.quantity == "scale") scale = static_cast<int>(c);
    if (channel.quantity == "bias") bias = static_cast<int>(c);
    if (channel.masking == "neubelt-clamped") {
      statements.push_back(
          "the visibility of the sheen is clamped to 1, which it exceeds near grazing");
    }
    if (!channel.known && !channel.constant) {
      statements.push_back(fmt::format("channel {} holds something else", channel.channel));
    }
  }
  if (scale >= 0 && bias >= 0 && bias < scale) {
    statements.push_back("scale and bias are swapped: bias comes first");
  }
}

void state_ceiling(const Finding& finding, std::vector<std::string>& statements) {
  const double ceiling = finding.comparison.reading.ceiling;
  for (size_t c = 0; c < finding.comparison.exact.size(); ++c) {
    const ChannelMatch& channel = finding.match.channels[c];
    // Cloth alone exceeds 1.
    if (!channel.known || channel.constant || channel.distribution != "charlie") continue;
    const std::vector<double>& exact = finding.comparison.exact[c];
    const auto count = std::count(exact.begin(), exact.end(), ceiling);
    if (count == 0) continue;
    statements.push_back(fmt::format(
        "channel {}: {} of {} entries stop at {:g}, the greatest number that this storage holds",
        channel.channel, count, exact.size(), ceiling));
  }
}

std::string attribute(const NumberArray& array, const std::string& name) {
  for (const auto& [key, value] : array.attributes) {
    if (key == name) return value;
  }
  return {};
}

// The word after "key=" in "key=word key=word".
std::string word_after(const std::string& text, const std::string& key) {
  const size_t at = text.find(key + "=");
  if (at == std::string::npos) return {};
  const size_t from = at + key.size() + 1;
  return text.substr(from, text.find_first_of(" ,;", from) - from);
}

void state_metadata(const Finding& finding, std::vector<std::string>& statements) {
  const std::string models = attribute(*finding.sheet.array, "kiln:models");
  const std::string masking = word_after(models, "masking");
  const std::string distribution = word_after(models, "distribution");
  for (const ChannelMatch& channel : finding.match.channels) {
    if (channel.masking.empty() || !channel.known) continue;
    if (channel.distribution == "charlie") continue;
    const bool same =
        masking == channel.masking || (masking == "unreal-joint" && channel.masking == "hammon");
    if (!masking.empty() && !same) {
      statements.push_back(
          fmt::format("metadata says masking {}, the entries are of {}", masking, channel.masking));
      break;
    }
    if (!distribution.empty() && distribution != channel.distribution) {
      statements.push_back(fmt::format("metadata says distribution {}, the entries are of {}",
                                       distribution, channel.distribution));
      break;
    }
  }
  const std::string axes = attribute(*finding.sheet.array, "kiln:axes");
  const bool says_x_mu = axes.starts_with("x=mu"), says_x_width = axes.starts_with("x=roughness");
  if ((says_x_mu && finding.candidate.axes.transposed) ||
      (says_x_width && !finding.candidate.axes.transposed)) {
    statements.push_back("metadata says " + axes + ", but the table is transposed");
  }
}

// Samples of the distribution whose noise this is, after measured noise of E: 128: 0.0089,
// 512: 0.0039, 1024: 0.0026, 4096: 0.0010, 16384: 0.0005, between them by powers.
double samples_of_noise(double rms) {
  static constexpr std::array<double, 5> samples{128, 512, 1024, 4096, 16384};
  static constexpr std::array<double, 5> noise{0.0089, 0.0039, 0.0026, 0.0010, 0.0005};
  size_t k = 1;
  while (k + 1 < noise.size() && rms < noise[k]) ++k;
  const double slope = std::log(samples[k] / samples[k - 1]) / std::log(noise[k] / noise[k - 1]);
  return samples[k] * std::pow(rms / noise[k], slope);
}

void state_noise(const Finding& finding, std::vector<std::string>& statements) {
  const double step = finding.sheet.decoding.step;
  double rms = 0;
  for (const ChannelMatch& channel : finding.match.channels) {
    if (channel.known) rms = std::max(rms, channel.rms_error);
  }
  if (rms < 2e-4 || rms < step) return;
  // One figure of two digits at most: it is an estimate.
  const double samples = std::max(samples_of_noise(rms), 16.0);
  const double power = std::exp2(std::round(std::log2(samples)));
  statements.push_back(fmt::format(
      "entries are off by {:.2g} rms, as after about {:.0f} samples of the distribution", rms,
      power));
}

}  // namespace

Candidate unshifted(Candidate candidate) {
  TableAxes& axes = candidate.axes;
  axes.cosine_alignment = shift_of(axes.cosine_alignment).from;
  axes.width_alignment = shift_of(axes.width_alignment).from;
  return candidate;
}

std::string not_finite_statement(const Sheet& sheet) {
  const auto count = std::count_if(sheet.array->values.begin(), sheet.array->values.end(),
                                   [](double value) { return !std::isfinite(value); });
  if (count == 0) return {};
  return fmt::format("{} of {} numbers are not finite", count, sheet.array->values.size());
}

std::vector<std::string> statements_on(const Finding& finding) {
  std::vector<std::string> statements;
  state_shift(finding, false, statements);
  if (!finding.sheet.is_curve()) state_shift(finding, true, statements);
  state_encodings(finding, statements);
  state_ceiling(finding, statements);
  state_metadata(finding, statements);
  state_noise(finding, statements);
  return statements;
}

}  // namespace kiln::validate
