// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "kiln/core/error.h"

namespace kiln::test {

/// The message of the Error that `work` throws, which must be of this fault.
template <class Work>
std::string fault_text(Fault fault, Work&& work) {
  try {
    work();
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), fault) << error.what();
    return error.what();
  }
  ADD_FAILURE() << "nothing was refused";
  return "";
}

}  // namespace kiln::test
