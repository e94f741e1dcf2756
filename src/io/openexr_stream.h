// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <OpenEXR/ImfIO.h>
#include <fmt/format.h>

#include <exception>
#include <string>

#include "kiln/core/error.h"
#include "kiln/store/byte_stream.h"

namespace kiln::io {

/// What the library writes, on its way to a file.
class ExrStream : public Imf::OStream {
 public:
  ExrStream(const std::string& shown_name, ByteStream& out)
      : Imf::OStream(shown_name.c_str()), out_(out) {}

  void write(const char bytes[], int count) override {
    out_.append({bytes, static_cast<size_t>(count)});
  }
  uint64_t tellp() override { return out_.position(); }
  void seekp(uint64_t position) override { out_.seek(position); }

 private:
  ByteStream& out_;
};

/// Runs `work`; the library's exceptions become Fault::Output, without the path.
template <class Work>
void writing_openexr(Work&& work) {
  try {
    work();
  } catch (const Error&) {
    throw;
  } catch (const std::exception& error) {
    throw Error(Fault::Output, fmt::format("cannot write: {}", error.what()));
  }
}

}  // namespace kiln::io
