#pragma once
// What a disk that fails is called: exit code 74, the path, why, and where room is short, how much is needed and free.
//
// Use        throw cannot_write(name, errno, bytes_so_far);
// Threads    free functions

#include <cstdint>
#include <filesystem>
#include <optional>

#include "engine/base/error.hpp"

namespace torquescope {

// bytes that a file of this name may take; nothing where the file system does not say
std::optional<std::uintmax_t> free_bytes_for(std::filesystem::path const& name);

// needed: bytes of the file as far as they are known, 0 when they are not
Error cannot_write(std::filesystem::path const& name, int error_number, std::uintmax_t needed = 0);

// a result that is not there: exit code 66, and which commands make one
Error no_such_result(std::filesystem::path const& name);

// ENOENT is exit code 66 (there is no such file), anything else 74: the file may be as good as ever
Error cannot_read(std::filesystem::path const& name, int error_number);

}  // namespace torquescope
