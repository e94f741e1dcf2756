// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <array>
#include <cstdio>

#include "image_folder.h"
#include "support/places.h"

namespace kiln {
namespace {

using namespace test;
using testing::HasSubstr;

// This program, copied to where no module stands beside it.
class Module : public ImageFolder {
 protected:
  struct Outcome {
    int status = 0;
    std::string text;
  };
  Outcome run_elsewhere(const std::string& environment, const std::string& one_test) const {
    fs::create_directories(folder / "bin");
    const fs::path program = folder / "bin" / "program";
    fs::copy_file("/proc/self/exe", program, fs::copy_options::overwrite_existing);
    const std::string command =
        environment + " " + program.string() + " --gtest_filter=" + one_test + " 2>&1";
    Outcome outcome;
    std::FILE* pipe = popen(command.c_str(), "r");
    std::array<char, 4096> part{};
    while (const size_t count = std::fread(part.data(), 1, part.size(), pipe)) {
      outcome.text.append(part.data(), count);
    }
    outcome.status = pclose(pipe);
    return outcome;
  }
};

constexpr char needs_module[] = "Png.NeverMultipliesColourByAlpha";

TEST_F(Module, SaysWhereItWasLookedFor) {
  const Outcome outcome = run_elsewhere("KILN_MODULE_PATH=/nowhere", needs_module);
  EXPECT_NE(outcome.status, 0);
  EXPECT_THAT(outcome.text, HasSubstr("is not installed; looked for '" + folder.string() +
                                      "/lib/kiln/kiln_openimageio.so' "
                                      "'/nowhere/kiln_openimageio.so'"));
}

TEST_F(Module, IsFoundByTheEnvironment) {
  const Outcome outcome = run_elsewhere(
      "KILN_MODULE_PATH=" + (test::build_folder() / "lib/kiln").string(), needs_module);
  EXPECT_EQ(outcome.status, 0) << outcome.text;
}

TEST_F(Module, IsFoundBesideTheProgram) {
  fs::create_directories(folder / "lib");
  fs::create_directory_symlink(test::build_folder() / "lib/kiln", folder / "lib" / "kiln");
  const Outcome outcome = run_elsewhere("KILN_MODULE_PATH=", needs_module);
  EXPECT_EQ(outcome.status, 0) << outcome.text;
}

TEST_F(Module, IsNotNeededForOpenExrAndRadiance) {
  const Outcome outcome = run_elsewhere("KILN_MODULE_PATH=", "OpenExr.*:RadianceHdr.Writes*");
  EXPECT_EQ(outcome.status, 0) << outcome.text;
}

TEST_F(Module, IsRefusedWhenItIsSomethingElse) {
  fs::create_directories(folder / "lib" / "kiln");
  write_bytes("lib/kiln/kiln_openimageio.so", "not a library");
  const Outcome outcome = run_elsewhere("KILN_MODULE_PATH=", needs_module);
  EXPECT_NE(outcome.status, 0);
  EXPECT_THAT(outcome.text, HasSubstr("kiln_openimageio.so: does not load: "));
}

}  // namespace
}  // namespace kiln
