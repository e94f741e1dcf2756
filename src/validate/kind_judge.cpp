// SPDX-License-Identifier: Apache-2.0
#include "kind_judge.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "statements.h"

namespace kiln::validate {
namespace {

constexpr int measured_plane = 64, measured_solid = 16, measured_next = 8;
constexpr double greatest_rms = 0.01;
constexpr double least_unexplained = 0.01;  // share of the variance
constexpr double hopeless = 0.05;           // a score that no finer look would mend

struct Errors {
  double greatest = 0, rms = 0;
  size_t worst = 0;
  bool known = false;
};

std::vector<Errors> errors_of(const KindComparison& comparison) {
  std::vector<Errors> all;
  all.reserve(comparison.fits.size());
  for (size_t c = 0; c < comparison.fits.size(); ++c) {
    const std::vector<double>& stored = comparison.values[c];
    Errors errors;
    errors.rms = comparison.fits[c].rms;
    for (size_t i = 0; i < stored.size(); ++i) {
      const double error = std::abs(stored[i] - comparison.exact[c][i]);
      if (error > errors.greatest) {
        errors.greatest = error;
        errors.worst = i;
      }
    }
    errors.known = comparison.fits[c].constant ||
                   (errors.rms <= greatest_rms &&
                    errors.rms * errors.rms <= least_unexplained * variance(stored));
    all.push_back(errors);
  }
  return all;
}

// "n.v" out of "u = n.v", "sqrt(F0)" out of "u = sqrt(F0); ...".
std::string axis_words(const AxisMapping& mapping, bool reversed) {
  std::string text = mapping.meaning.substr(mapping.meaning.find('=') + 2);
  text = text.substr(0, text.find_first_of(",;"));
  return reversed ? text + ", from the other end" : text;
}

std::string convention_of(const Match& match, const KindReading& reading) {
  std::string text;
  for (const ChannelMatch& channel : match.channels) {
    if (!text.empty()) text += ", ";
    fmt::format_to(std::back_inserter(text), "{} = {}", channel.channel, channel.quantity);
  }
  const char* separator = "; ";
  for (size_t a = 0; a < reading.order.size(); ++a) {
    fmt::format_to(std::back_inserter(text), "{}{} = {}", separator, "xyz"[a],
                   axis_words(*reading.mappings[reading.order[a]], reading.reversed[a]));
    separator = ", ";
  }
  text += reading.alignment == Alignment::Center ? "; entries at centres (i + 1/2) / N; "
                                                 : "; entries at nodes i / (N - 1); ";
  return text + match.decoding;
}

// Where the greatest error sits.
void locate(const KindComparison& comparison, const KindReading& reading, size_t at, Match& match) {
  int* const places[] = {&match.x, &match.y, &match.z};
  for (size_t a = 0; a < reading.order.size(); ++a) {
    const size_t k = at % comparison.places[a].size();
    at /= comparison.places[a].size();
    *places[a] = comparison.places[a][k];
    const Quantity quantity = reading.mappings[reading.order[a]]->quantity;
    if (quantity == Quantity::Mu) match.mu = comparison.coordinates[a][k];
    if (quantity == Quantity::Roughness) match.roughness = comparison.coordinates[a][k];
  }
}

void measure(const Sheet& sheet, const KindComparison& comparison, const KindReading& reading,
             const std::vector<Errors>& errors, Match& match) {
  double squares = 0;
  int known = 0;
  for (size_t c = 0; c < errors.size(); ++c) {
    if (!errors[c].known || comparison.fits[c].constant) continue;
    squares += errors[c].rms * errors[c].rms;
    if (++known > 1 && errors[c].greatest <= match.max_error) continue;
    match.max_error = errors[c].greatest;
    match.channel = sheet.channels[c];
    locate(comparison, reading, errors[c].worst, match);
  }
  match.rms_error = known > 0 ? std::sqrt(squares / known) : 0;
}

Match describe(const Sheet& sheet, const KindCandidate& candidate, const KindComparison& comparison,
               const std::vector<Errors>& errors) {
  const Kind& kind = all_kinds()[candidate.reading.kind];
  Match match;
  match.array = sheet.array->name;
  match.arrangement = sheet.arrangement.words;
  match.decoding = sheet.decoding.words;
  match.table_class = kind.table;
  for (size_t c = 0; c < errors.size(); ++c) {
    const KindFit& fit = comparison.fits[c];
    ChannelMatch channel{sheet.channels[c], "unknown",       "",          "", errors[c].greatest,
                         errors[c].rms,     errors[c].known, fit.constant};
    if (fit.constant) channel.quantity = fmt::format("constant {:.6g}", fit.level);
    if (fit.content >= 0 && errors[c].known) channel.quantity = kind.contents[fit.content].words;
    match.channels.push_back(std::move(channel));
  }
  match.convention = convention_of(match, candidate.reading);
  measure(sheet, comparison, candidate.reading, errors, match);
  return match;
}

Layers error_layers(const Sheet& sheet, const KindComparison& comparison,
                    const std::vector<Errors>& errors) {
  const int width = static_cast<int>(comparison.places[0].size());
  const int height = static_cast<int>(comparison.values[0].size()) / width;
  Layers layers{{width, height}, {}};
  for (size_t c = 0; c < errors.size(); ++c) {
    if (!errors[c].known || comparison.fits[c].constant) continue;
    Plane& plane = layers.add("error." + sheet.channels[c]);
    for (int i = 0; i < width * height; ++i) {
      plane.at(i % width, i / width) =
          static_cast<float>(comparison.values[c][i] - comparison.exact[c][i]);
    }
  }
  return layers;
}

bool fits_all(const KindComparison& comparison, const std::vector<Errors>& errors) {
  bool any = false;
  for (size_t c = 0; c < errors.size(); ++c) {
    if (!errors[c].known) return false;
    any = any || !comparison.fits[c].constant;
  }
  return any;
}

// Of glass: both sides together, what refraction turns back counted or not.
bool holds_all_of_glass(const Content& content) {
  return content.words.find("let through") != std::string::npos &&
         content.words.find("reflected") != std::string::npos;
}

// Cycles: roughness along x, n.v along y, the index or exponent along z, on nodes.
bool is_of_cycles(const KindCandidate& candidate) {
  const KindReading& reading = candidate.reading;
  const Kind& kind = all_kinds()[reading.kind];
  const bool share = kind.table == "ior-share" || kind.table == "schlick-share";
  if ((kind.table != "glass" && !share) || reading.alignment != Alignment::Corner) return false;
  if (candidate.fits.size() != 1 || reading.order != std::vector<int>{1, 0, 2}) return false;
  if (std::count(reading.reversed.begin(), reading.reversed.end(), true) > 0) return false;
  for (size_t q = 0; q < reading.mappings.size(); ++q) {
    if (reading.mappings[q] != kind.axes[q][0]) return false;
  }
  return share || holds_all_of_glass(kind.contents[candidate.fits[0].content]);
}

}  // namespace

Verdict verify_kinds(const std::vector<Sheet>& sheets) {
  Verdict verdict;
  const std::vector<KindCandidate> candidates = search_kinds(sheets);
  if (candidates.empty() || candidates[0].score > hopeless) return verdict;
  const KindCandidate& best = candidates[0];
  const Sheet& sheet = sheets[best.sheet];
  const bool solid = sheet.arrangement.depth > 1;
  const KindComparison comparison = compare(sheet, best, solid ? measured_solid : measured_plane);
  const std::vector<Errors> errors = errors_of(comparison);
  verdict.best = describe(sheet, best, comparison, errors);
  verdict.fits = fits_all(comparison, errors);
  if (!verdict.fits) return verdict;
  verdict.errors = error_layers(sheet, comparison, errors);
  if (candidates.size() > 1) {
    const KindCandidate& next = candidates[1];
    const Sheet& other = sheets[next.sheet];
    const KindComparison coarse = compare(other, next, measured_next);
    verdict.runner_up = describe(other, next, coarse, errors_of(coarse));
    verdict.ratio = next.score / std::max(best.score, 1e-12);
  }
  if (verdict.runner_up && verdict.ratio < 1.2) {
    verdict.statements.push_back("cannot be told apart from: " + verdict.runner_up->convention);
  }
  if (is_of_cycles(best)) verdict.presets.push_back("cycles");
  if (std::string text = not_finite_statement(sheet); !text.empty()) {
    verdict.statements.push_back(std::move(text));
  }
  return verdict;
}

}  // namespace kiln::validate
