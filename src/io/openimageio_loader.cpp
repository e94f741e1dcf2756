// SPDX-License-Identifier: Apache-2.0
#include "openimageio_loader.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <vector>

#include "kiln/core/error.h"

namespace kiln::io {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> candidates() {
  std::vector<fs::path> result;
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  if (!error) {
    result.push_back(program.parent_path().parent_path() / "lib" / "kiln" / module::file_name);
  }
  if (const char* folder = std::getenv("KILN_MODULE_PATH"); folder != nullptr && *folder != '\0') {
    result.push_back(fs::path(folder) / module::file_name);
  }
  return result;
}

fs::path module_path() {
  std::string looked;
  for (const fs::path& path : candidates()) {
    std::error_code error;
    if (fs::exists(path, error)) return path;
    looked += fmt::format(" '{}'", path.string());
  }
  throw Error(Fault::Internal,
              fmt::format("the module that reads and writes this format is not installed; looked "
                          "for{} (KILN_MODULE_PATH may name its folder)",
                          looked));
}

// A logging library among the decoders' many dependencies starts idle threads when it is loaded;
// they are sent home, since the user's limit on threads is for the whole process.
void stop_idle_threads(void* library) {
  if (void* stop = dlsym(library, "_ZN9log4cplus18shutdownThreadPoolEv")) {
    reinterpret_cast<void (*)()>(stop)();
  }
}

// What the build found to be heavy (CMakeLists.txt); of what is not here any more the module tells.
void load_heavy_libraries() {
  for (const char* name : {KILN_HEAVY_LIBRARIES}) dlopen(name, RTLD_NOW | RTLD_LOCAL);
}

const module::Face& load() {
  const fs::path path = module_path();
  load_heavy_libraries();
  void* library = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) {
    throw Error(Fault::Internal, fmt::format("{}: does not load: {}", path.string(), dlerror()));
  }
  auto* entry = reinterpret_cast<module::Entry>(dlsym(library, module::entry_name));
  if (entry == nullptr || entry()->version != module::face_version) {
    throw Error(Fault::Internal,
                fmt::format("{}: does not belong to this version of kiln", path.string()));
  }
  stop_idle_threads(library);
  return *entry();
}

}  // namespace

const module::Face& openimageio() {
  static const module::Face& face = load();
  return face;
}

// Without what the library puts at the end of its messages.
std::string openimageio_error() {
  std::string text = openimageio().last_error();
  std::replace(text.begin(), text.end(), '\n', ' ');
  text.erase(text.find_last_not_of(" .") + 1);
  return text.empty() ? "the decoder gives no reason" : text;
}

}  // namespace kiln::io
