// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/wait.h>
#include <unistd.h>

#include <string>
#include <vector>

#include "workshop.h"

namespace kiln::test {

struct Outcome {
  int code = -1;
  std::string out;
  std::string err;
};

/// A command that runs beside the test, its stdout and stderr going to files.
class Command {
 public:
  Command(const Workshop& shop, const std::vector<std::string>& arguments)
      : out_(shop / "stdout.txt"), err_(shop / "stderr.txt") {
    pid_ = fork();
    if (pid_ != 0) return;
    if (!freopen(out_.c_str(), "w", stdout) || !freopen(err_.c_str(), "w", stderr)) _exit(99);
    std::vector<char*> words = {const_cast<char*>(KILN_COMMAND)};
    for (const std::string& word : arguments) words.push_back(const_cast<char*>(word.c_str()));
    words.push_back(nullptr);
    unsetenv("OCIO");
    execv(KILN_COMMAND, words.data());
    _exit(98);
  }

  void send(int signal) const { kill(pid_, signal); }

  /// Waits for the end. A code above 1000 means killed by that signal.
  Outcome wait() const {
    int status = 0;
    waitpid(pid_, &status, 0);
    const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status);
    return {code, text_of(out_), text_of(err_)};
  }

 private:
  std::filesystem::path out_, err_;
  pid_t pid_ = -1;
};

inline Outcome kiln(const Workshop& shop, const std::vector<std::string>& arguments) {
  return Command(shop, arguments).wait();
}

}  // namespace kiln::test
