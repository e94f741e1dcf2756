// SPDX-License-Identifier: Apache-2.0
#include <CLI/Error.hpp>
#include <cstdio>
#include <exception>
#include <new>
#include <string>
#include <vector>

#include "kiln/core/error.h"
#include "print_error.h"
#include "verb.h"

namespace {

int complain(const std::string& message, int code) {
  kiln::print_error(message);
  return code;
}

}  // namespace

int main(int count, char** words) {
  if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma")) {
    std::fputs("kiln: error: this build needs a processor with AVX2 and FMA\n", stderr);
    return kiln::exit_code(kiln::Fault::Usage);
  }
  try {
    return kiln::run_command(std::vector<std::string>(words + 1, words + count));
  } catch (const kiln::Error& error) {
    return complain(error.what(), kiln::exit_code(error.fault()));
  } catch (const CLI::ParseError& error) {
    return complain(error.what(), kiln::exit_code(kiln::Fault::Usage));
  } catch (const std::bad_alloc&) {
    return complain("out of memory", kiln::exit_code(kiln::Fault::Memory));
  } catch (const std::exception& defect) {
    return complain(defect.what(), kiln::exit_code(kiln::Fault::Internal));
  }
}
