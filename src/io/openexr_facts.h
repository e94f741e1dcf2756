// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <fmt/format.h>

#include <exception>
#include <new>
#include <string>

#include "kiln/core/error.h"
#include "kiln/io/image_file.h"

namespace kiln::io {

/// The library's own threads stay off, so that the limit on our threads bounds the process; and its
/// headers may not claim sizes whose tables alone would fill the memory.
void bound_openexr();

/// The library's reason, without the path that it puts in front.
std::string openexr_reason(const std::exception& error);

/// Runs `work` with the library bounded; everything that the library throws becomes Fault::Input.
template <class Work>
auto reading_openexr(Work&& work) {
  bound_openexr();
  try {
    return work();
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw Error(Fault::Input, "damaged OpenEXR file, or too large for memory");
  } catch (const std::exception& error) {
    throw Error(Fault::Input, fmt::format("damaged OpenEXR file: {}", openexr_reason(error)));
  }
}

/// Inclusive window -> extent, without overflow for any pair of corners.
inline long long extent(int min, int max) { return static_cast<long long>(max) - min + 1; }

/// What a part is read for.
enum class Reading {
  Image,    ///< its display window; notes say what else there is
  Texture,  ///< its data window with all levels
};

/// What the first part says of itself; the size is that of the display window.
/// @error Fault::Input, without the path, for what is not read or too large
FileFacts openexr_facts(Imf::MultiPartInputFile& file, Reading reading, const ReadLimits& limits);

}  // namespace kiln::io
