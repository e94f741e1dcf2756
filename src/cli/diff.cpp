// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "kiln/core/error.h"
#include "kiln/core/param.h"
#include "kiln/image/compare.h"
#include "kiln/io/image_file.h"
#include "verb.h"

namespace kiln {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

struct DiffArguments {
  std::string a, b, max_error, rms;
};

struct Allowed {
  std::optional<double> max, rms;
};

/// Two files of one name, or one without its like.
struct Compared {
  std::string name;
  std::optional<Difference> difference;
  std::string problem;  ///< why they could not be compared
  bool differs = false;
};

std::optional<double> parse_limit(const std::string& option, const std::string& text) {
  if (text.empty()) return std::nullopt;
  ParamFacts facts;
  facts.name = option;
  facts.min = 0;
  return parse_number(facts, text);
}

// Without a limit nothing may differ at all. NaN differs.
Allowed allowed_of(const DiffArguments& arguments) {
  Allowed allowed{parse_limit("--max-error", arguments.max_error),
                  parse_limit("--rms", arguments.rms)};
  if (!allowed.max && !allowed.rms) allowed.max = 0;
  return allowed;
}

bool exceeds(const Difference& difference, const Allowed& allowed) {
  const bool max_kept = !allowed.max || difference.max <= *allowed.max;
  const bool rms_kept = !allowed.rms || difference.rms <= *allowed.rms;
  return !(max_kept && rms_kept);
}

std::vector<std::string> channel_names(const Layers& image) {
  std::vector<std::string> names;
  for (const Layer& layer : image.layers) names.push_back(layer.name);
  return names;
}

std::string shape_of(const Layers& image) {
  return fmt::format("{}x{} {}", image.size.width, image.size.height,
                     fmt::join(channel_names(image), ","));
}

Compared compare_files(const fs::path& a, const fs::path& b, const std::string& name,
                       const Allowed& allowed) {
  Compared compared{name, std::nullopt, "", true};
  const Layers left = read_image(a).image, right = read_image(b).image;
  if (left.size != right.size || channel_names(left) != channel_names(right)) {
    compared.problem = fmt::format("{} against {}", shape_of(left), shape_of(right));
    return compared;
  }
  compared.difference = compare(left, right);
  compared.differs = exceeds(*compared.difference, allowed);
  return compared;
}

bool is_image(const fs::path& path) {
  static const std::set<std::string> known = {".exr", ".png", ".jpg", ".jpeg",
                                              ".hdr", ".tif", ".tiff"};
  return known.contains(path.extension().string());
}

std::set<std::string> images_below(const fs::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file() || !is_image(entry.path())) continue;
    names.insert(entry.path().lexically_relative(folder).generic_string());
  }
  return names;
}

std::vector<Compared> compare_folders(const fs::path& a, const fs::path& b,
                                      const Allowed& allowed) {
  const std::set<std::string> left = images_below(a), right = images_below(b);
  std::set<std::string> all = left;
  all.insert(right.begin(), right.end());
  std::vector<Compared> list;
  for (const std::string& name : all) {
    if (left.contains(name) && right.contains(name)) {
      list.push_back(compare_files(a / name, b / name, name, allowed));
    } else {
      const std::string only = left.contains(name) ? a.string() : b.string();
      list.push_back({name, std::nullopt, "only in " + only, true});
    }
  }
  if (list.empty()) {
    throw Error(Fault::Input, fmt::format("no image in {} or {}", a.string(), b.string()));
  }
  return list;
}

void require_exists(const std::string& path) {
  std::error_code failure;
  if (!fs::exists(path, failure)) throw Error(Fault::Input, path + ": no such file or folder");
}

void print_table(const std::vector<Compared>& list) {
  size_t width = 4;
  for (const Compared& compared : list) width = std::max(width, compared.name.size());
  fmt::print("{:<{}}  {:>10}  {:>10}  {:>10}  {:>10}\n", "file", width, "mean", "rms", "95 %",
             "max");
  for (const Compared& compared : list) {
    if (compared.difference) {
      const Difference& d = *compared.difference;
      fmt::print("{:<{}}  {:>10.4g}  {:>10.4g}  {:>10.4g}  {:>10.4g}{}\n", compared.name, width,
                 d.mean, d.rms, d.percentile_95, d.max, compared.differs ? "  differs" : "");
    } else {
      fmt::print("{:<{}}  {}  differs\n", compared.name, width, compared.problem);
    }
  }
}

void print_json(const std::vector<Compared>& list) {
  Json json = Json::array();
  for (const Compared& compared : list) {
    Json entry = {{"file", compared.name}, {"differs", compared.differs}};
    if (compared.difference) {
      const Difference& d = *compared.difference;
      entry.update(
          {{"mean", d.mean}, {"rms", d.rms}, {"percentile_95", d.percentile_95}, {"max", d.max}});
    } else {
      entry["problem"] = compared.problem;
    }
    json.push_back(entry);
  }
  fmt::print("{}\n", json.dump(2));
}

int run(const DiffArguments& arguments, const Globals& globals) {
  if (arguments.a.empty() || arguments.b.empty()) {
    throw Error(Fault::Usage, "expected A and B: two images, or two folders of them");
  }
  const Allowed allowed = allowed_of(arguments);
  require_exists(arguments.a);
  require_exists(arguments.b);
  const bool folder_a = fs::is_directory(arguments.a), folder_b = fs::is_directory(arguments.b);
  if (folder_a != folder_b) {
    throw Error(Fault::Usage, "expected two images or two folders, found one of each");
  }
  const std::vector<Compared> list =
      folder_a
          ? compare_folders(arguments.a, arguments.b, allowed)
          : std::vector<Compared>{compare_files(arguments.a, arguments.b, arguments.b, allowed)};
  if (globals.json) {
    print_json(list);
  } else if (!globals.quiet) {
    print_table(list);
  }
  const bool any = std::any_of(list.begin(), list.end(),
                               [](const Compared& compared) { return compared.differs; });
  return any ? exit_code(Fault::Difference) : 0;
}

Action declare(CLI::App& app) {
  const auto arguments = std::make_shared<DiffArguments>();
  app.add_option("A", arguments->a, "image, or folder of images")->type_name("");
  app.add_option("B", arguments->b, "what to compare it with")->type_name("");
  app.add_option("--max-error", arguments->max_error, "allowed greatest difference (default 0)")
      ->type_name("X");
  app.add_option("--rms", arguments->rms, "allowed root of the mean square; alone, the only limit")
      ->type_name("X");
  return [arguments](const Globals& globals) { return run(*arguments, globals); };
}

}  // namespace

Verb diff_verb() { return {"diff", "A B", "compare two images or two folders of them", declare}; }

}  // namespace kiln
