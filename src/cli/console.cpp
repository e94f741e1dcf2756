// SPDX-License-Identifier: Apache-2.0
#include "console.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cstdio>
#include <memory>

#include "kiln/core/param.h"

namespace kiln {
namespace {

int terminal_columns() {
  winsize window{};
  return ioctl(STDERR_FILENO, TIOCGWINSZ, &window) == 0 && window.ws_col > 0 ? window.ws_col - 1
                                                                             : 79;
}

/// Lines on stderr; on a terminal the last one may be a bar that is drawn over.
class Console {
 public:
  Console(ProgressStyle style, const Globals& globals)
      : style_(style),
        // A log tells everything; a bar only what went wrong.
        tells_all_(globals.verbose || (style == ProgressStyle::Plain && !globals.quiet)),
        quiet_(globals.quiet),
        colored_(globals.color == "always" ||
                 (globals.color == "auto" && isatty(STDERR_FILENO) != 0)) {}

  void began(const TaskRecord& record, const Progress& progress) {
    if (style_ == ProgressStyle::Terminal) draw(record, progress);
  }

  void ended(const TaskRecord& record, const Progress& progress) {
    if (style_ == ProgressStyle::Json) return line(progress_json(record, progress));
    const std::string text = progress_line(record, progress);
    if (record.fault) {
      line(painted(text, "31"));
    } else if (style_ == ProgressStyle::Plain) {
      line(text);
    }
    if (tells_all_) notes(record);
    if (style_ == ProgressStyle::Terminal) last(record, progress);
  }

  void say(const std::string& text) {
    if (tells_all_) line(text);
  }

  void warn(const std::string& text) {
    if (!quiet_) line(painted("warning: ", "33") + text);
  }

 private:
  void draw(const TaskRecord& record, const Progress& progress) {
    fmt::print(stderr, "\r\x1b[K{}", progress_bar(record, progress, terminal_columns()));
    std::fflush(stderr);
    drawn_ = true;
  }

  void last(const TaskRecord& record, const Progress& progress) {
    draw(record, progress);
    if (progress.done == progress.total) clear();
  }

  void notes(const TaskRecord& record) {
    for (const std::string& note : record.notes) line(fmt::format("  {}: {}", record.out, note));
  }

  void line(const std::string& text) {
    clear();
    fmt::print(stderr, "{}\n", text);
  }

  void clear() {
    if (drawn_) fmt::print(stderr, "\r\x1b[K");
    drawn_ = false;
  }

  std::string painted(const std::string& text, const std::string& code) const {
    return colored_ ? "\x1b[" + code + "m" + text + "\x1b[0m" : text;
  }

  ProgressStyle style_;
  bool tells_all_, quiet_, colored_;
  bool drawn_ = false;
};

std::string listed(const std::string& title, const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += fmt::format("\n  {}: {}", title, line);
  return text;
}

}  // namespace

ProgressStyle progress_style(const std::string& word, const Globals& globals) {
  ParamFacts facts;
  facts.name = "--progress";
  facts.choices = {"auto", "tty", "plain", "json", "none"};
  const size_t chosen = parse_word(facts, word);
  if (chosen > 0) return static_cast<ProgressStyle>(chosen - 1);
  if (globals.quiet) return ProgressStyle::None;
  return isatty(STDERR_FILENO) != 0 ? ProgressStyle::Terminal : ProgressStyle::Plain;
}

Watcher console_watcher(ProgressStyle style, const Globals& globals) {
  const auto console = std::make_shared<Console>(style, globals);
  Watcher watcher;
  watcher.began = [console](const TaskRecord& task, const Progress& progress) {
    console->began(task, progress);
  };
  watcher.ended = [console](const TaskRecord& task, const Progress& progress) {
    console->ended(task, progress);
  };
  watcher.loaded = [console](const SetRecord& set) { console->say(told(set)); };
  watcher.lit = [console](const EnvironmentRecord& record) { console->say(told(record)); };
  watcher.warned = [console](const std::string& text) { console->warn(text); };
  return watcher;
}

std::string told(const SetRecord& set) {
  std::string text = fmt::format("{}: {}", set.name, set.workflow);
  for (const MapRecord& map : set.maps) {
    text += fmt::format("\n  {:<17} <- {}{}: {}{}", map.slot, map.source,
                        map.channels.empty() ? "" : " [" + map.channels + "]", map.reason,
                        map.color.empty() ? "" : "; " + map.color);
  }
  return text + listed("note", set.notes);
}

std::string told(const EnvironmentRecord& environment) {
  return fmt::format("environment {} <- {}: {}", environment.name, environment.source,
                     environment.color) +
         listed("note", environment.notes);
}

}  // namespace kiln
