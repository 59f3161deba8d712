#pragma once
// Numbers in a small file that somebody else may take up: there and right in every bit, or not there.
//
// Layout     8 letters, the key (32 bytes), how many numbers (8 bytes), the numbers, SHA-256 of all before;
//            little-endian
// Writing    as TempFile: under its name when it is whole and safe against power loss
// Trust      a file counts when its length, key and SHA-256 are right; no library reads it, so nothing can crash on it
// Errors     writing: 74. Reading: none; whatever cannot be read is `damaged`
// Threads    free functions

#include <cstddef>
#include <filesystem>
#include <span>

#include "engine/base/digest.hpp"

namespace torquescope {

std::size_t number_file_bytes(std::size_t numbers);

void write_number_file(std::filesystem::path const& name, Sha256 const& key, std::span<double const> numbers);

enum class NumberFile { whole, missing, foreign, damaged };  // foreign: of another key

// fills `numbers` when it is whole, and may leave anything in them when it is not
NumberFile read_number_file(std::filesystem::path const& name, Sha256 const& key, std::span<double> numbers);

}  // namespace torquescope
