// SPDX-License-Identifier: Apache-2.0
#include "kiln/validate/verify.h"

#include <fmt/format.h>

#include <algorithm>

#include "judge.h"
#include "kind_judge.h"
#include "ltc_reading.h"
#include "presets.h"
#include "statements.h"

namespace kiln {
namespace validate {
namespace {

constexpr double hopeless = 0.06;  // a score that no other lobe would mend
constexpr size_t looked_at = 4;
constexpr int entries_measured = 512, entries_screened = 48, entries_aligned = 32;

// Whether some channel follows the candidate, if only roughly.
bool follows(const Sheet& sheet, const Candidate& candidate) {
  constexpr double rough_rms = 0.05, rough_share = 0.2;
  const bool transposed = candidate.axes.transposed;
  const Values values = values_of(sheet, transposed, spread_places(sheet, transposed, 16));
  for (size_t c = 0; c < values.size(); ++c) {
    const ChannelFit& fit = candidate.fits[c];
    if (fit.constant || fit.rms > rough_rms) continue;
    if (fit.rms * fit.rms <= rough_share * variance(values[c])) return true;
  }
  return false;
}

// A finer look at the few that are left, for noise hides small shifts from a coarse one.
void look_closer(const std::vector<Sheet>& sheets, std::vector<Candidate>& candidates) {
  const auto better = [](const Candidate& a, const Candidate& b) {
    return handicapped(a) < handicapped(b);
  };
  const auto first = candidates.begin();
  const auto last = first + static_cast<long>(std::min(candidates.size(), looked_at));
  const double worth = 1.5 * first->score + 1e-6;
  for (auto one = first; one != last; ++one) {
    if (one->score <= worth) *one = align(sheets[one->sheet], *one, entries_aligned);
  }
  std::stable_sort(first, last, better);
  const double close = 1.5 * first->score + 0.003;
  for (auto one = first; one != last; ++one) {
    if (one->score > close || !follows(sheets[one->sheet], *one)) continue;
    *one = settle(sheets[one->sheet], *one, entries_aligned);
  }
  std::stable_sort(first, last, better);
}

// Of the other classes the one whose errors are least in the channels that the best one explains.
// Other arrangements of the same numbers compare ill and count only where there is nothing else.
const Candidate* runner_up(const std::vector<Sheet>& sheets,
                           const std::vector<Candidate>& candidates,
                           const std::vector<ChannelErrors>& errors) {
  const Candidate& best = candidates[0];
  const auto alike = [&](const Candidate& other) {
    return sheets[other.sheet].array == sheets[best.sheet].array &&
           sheets[other.sheet].arrangement.words == sheets[best.sheet].arrangement.words &&
           other.fits.size() == best.fits.size();
  };
  const Candidate* next = nullptr;
  for (size_t i = 1; i < candidates.size(); ++i) {
    const Candidate& one = candidates[i];
    if (next == nullptr || (alike(one) && !alike(*next)) ||
        (alike(one) == alike(*next) &&
         ratio_between(errors, best, one) < ratio_between(errors, best, *next))) {
      next = &one;
    }
  }
  return next;
}

// All channels by their nearest meaning, for a table that nothing fits.
std::vector<ChannelErrors> nearest_of(std::vector<ChannelErrors> errors) {
  for (ChannelErrors& one : errors) one.known = true;
  return errors;
}

// All entries are measured of tables that a part of them leaves in the running.
Comparison measured(const Sheet& sheet, const Candidate& candidate) {
  constexpr double any_ratio = 1e9;
  Comparison part = compare(sheet, candidate, entries_screened);
  if (!acceptable(sheet, errors_of(part), any_ratio)) return part;
  return compare(sheet, candidate, entries_measured);
}

void judge(const std::vector<Sheet>& sheets, const std::vector<Candidate>& candidates,
           Verdict& verdict) {
  const Candidate& best = candidates[0];
  const Sheet& sheet = sheets[best.sheet];
  const Comparison comparison = measured(sheet, best);
  const std::vector<ChannelErrors> errors = errors_of(comparison);
  verdict.best = describe(sheet, best, comparison);
  if (const Candidate* next = runner_up(sheets, candidates, errors)) {
    const Sheet& other = sheets[next->sheet];
    verdict.runner_up = describe(other, *next, compare(other, *next, entries_aligned), errors);
    verdict.ratio = ratio_between(errors, best, *next);
  }
  verdict.fits = acceptable(sheet, errors, verdict.ratio);
  verdict.errors = error_layers(sheet, best, comparison);
  if (const std::string text = not_finite_statement(sheet); !text.empty()) {
    verdict.statements.push_back(text);
  }
  if (!verdict.fits) {
    verdict.best = describe(sheet, best, comparison, nearest_of(errors));
    return;
  }
  verdict.presets = presets_like(sheet, unshifted(best));
  for (std::string& text : statements_on({sheet, best, comparison, verdict.best})) {
    verdict.statements.push_back(std::move(text));
  }
  if (verdict.runner_up && verdict.ratio < 1.2) {
    verdict.statements.push_back("cannot be told apart from: " + verdict.runner_up->convention);
  }
}

Verdict verify_sheets(const std::vector<Sheet>& sheets) {
  Verdict verdict;
  for (const Effort effort : {Effort::CommonLobes, Effort::AllLobes}) {
    verdict = {};
    std::vector<Candidate> candidates = search(sheets, effort);
    if (candidates.empty()) break;
    look_closer(sheets, candidates);
    judge(sheets, candidates, verdict);
    if (verdict.fits || candidates[0].score > hopeless) break;
  }
  return verdict;
}

// Channels of the best match that hold something unknown.
bool leaves_channels(const Verdict& verdict) {
  return std::any_of(verdict.best.channels.begin(), verdict.best.channels.end(),
                     [](const ChannelMatch& channel) { return !channel.known; });
}

// Kinds that are quick to tell first, then lobes, then what may explain more than they do.
Verdict verify_arrays(const std::vector<NumberArray>& arrays) {
  Verdict verdict = verify_kinds(solid_sheets(arrays));
  if (verdict.fits) return verdict;
  const std::vector<Sheet> sheets = possible_sheets(arrays);
  verdict = verify_cosines(sheets);
  if (verdict.fits) return verdict;
  verdict = verify_sheets(sheets);
  if (verdict.fits && !leaves_channels(verdict)) return verdict;
  Verdict other = verify_kinds(sheets);
  return other.fits ? other : verdict;
}

// What the arrays hold beside the one that was judged.
std::vector<Match> other_matches(const std::vector<NumberArray>& arrays, const Verdict& verdict) {
  std::vector<Match> others;
  bool one_of_them = false;
  for (const NumberArray& array : arrays) one_of_them |= array.name == verdict.best.array;
  if (!one_of_them || arrays.size() < 2) return others;
  for (const NumberArray& array : arrays) {
    if (array.name == verdict.best.array) continue;
    Verdict other = verify_arrays({array});
    if (other.fits) others.push_back(std::move(other.best));
  }
  return others;
}

}  // namespace
}  // namespace validate

Verdict verify_tables(const std::vector<NumberArray>& arrays, const VerifyOptions& options) {
  Verdict verdict = validate::verify_sheets(validate::joined_sheets(arrays));
  if (!verdict.fits) verdict = validate::verify_arrays(arrays);
  if (verdict.fits) verdict.others = validate::other_matches(arrays, verdict);
  if (options.max_error > 0) {
    verdict.within = verdict.fits && verdict.best.max_error <= options.max_error;
  }
  return verdict;
}

}  // namespace kiln
