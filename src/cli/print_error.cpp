// SPDX-License-Identifier: Apache-2.0
#include "print_error.h"

#include <algorithm>
#include <cstdio>

namespace kiln {

void print_error(const std::string& message) {
  for (size_t begin = 0; begin <= message.size();) {
    const size_t end = std::min(message.find('\n', begin), message.size());
    std::fprintf(stderr, "kiln: error: %s\n", message.substr(begin, end - begin).c_str());
    begin = end + 1;
  }
}

}  // namespace kiln
