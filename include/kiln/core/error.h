// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

namespace kiln {

/// Whose fault an error is. The value is the process's exit code.
enum class Fault {
  Usage = 2,         ///< wrong command line or pipeline file
  Input = 3,         ///< an input is missing or unreadable
  Validation = 4,    ///< a check failed
  Output = 5,        ///< an output cannot be written
  Internal = 6,      ///< a defect of kiln
  Difference = 7,    ///< two results differ by more than allowed
  Memory = 33,       ///< the memory budget does not suffice
  Interrupted = 130  ///< stopped by the user
};

/// The one exception of the library: a fault and a message that says what was found, what was
/// expected, and where.
class Error : public std::runtime_error {
 public:
  Error(Fault fault, const std::string& message) : std::runtime_error(message), fault_(fault) {}
  Fault fault() const noexcept { return fault_; }

 private:
  Fault fault_;
};

inline int exit_code(Fault fault) { return static_cast<int>(fault); }

/// Runs `work`; an Error that leaves it is rethrown as "context: message", with the same fault.
template <class Work>
decltype(auto) with_context(const std::string& context, Work&& work) {
  try {
    return std::forward<Work>(work)();
  } catch (const Error& error) {
    throw Error(error.fault(), context + ": " + error.what());
  }
}

}  // namespace kiln
