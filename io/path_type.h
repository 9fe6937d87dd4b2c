#pragma once

#include <filesystem>

namespace io {

/// What stands at a path, links followed; not_found when nothing does.
/// @throws InputError when that cannot be told, with the reason (no permission, a ring of links,
///   a link to nothing)
std::filesystem::file_type TypeAt(const std::filesystem::path& path);

/// Whether anything stands there. @throws InputError, see TypeAt
bool Exists(const std::filesystem::path& path);

/// "a folder", "a pipe", "a device" ...
const char* NameOf(std::filesystem::file_type type);

}  // namespace io
