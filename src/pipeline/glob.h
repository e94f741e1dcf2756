// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace kiln {

/// Whether the whole text is what the pattern says: * any letters, ? one letter.
bool matches(std::string_view pattern, std::string_view text);

/// The folders, or regular files, whose path a pattern describes, component by component, sorted by
/// their bytes. Names that begin with a dot are met only by a pattern that does so too.
std::vector<std::filesystem::path> expand_folders(const std::string& pattern);
std::vector<std::filesystem::path> expand_files(const std::string& pattern);

/// Names of the regular files in a folder, sorted by their bytes, without hidden ones.
std::vector<std::string> files_in(const std::filesystem::path& folder);

}  // namespace kiln
