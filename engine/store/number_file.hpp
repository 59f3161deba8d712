#pragma once
// Numbers in a small file that somebody else may take up: there and right in every bit, or not there.
//
// Layout     8 letters, the identity of the job (32 bytes, file_seal.hpp), the key (32), how many numbers (8), the
//            numbers, SHA-256 of all before; little-endian
// Writing    as TempFile: under its name when it is whole and safe against power loss
// Trust      a file counts when its length, key and SHA-256 are right; no library reads it, so nothing can crash on it
// Errors     writing: 74. Reading: none; whatever cannot be read is `damaged`
// Threads    free functions

#include <cstddef>
#include <optional>
#include <span>

#include "engine/base/digest.hpp"
#include "engine/store/file_place.hpp"

namespace torquescope {

// whose file it is, and what its numbers follow from
struct NumberFileKey {
  Sha256 job, key;
};

std::size_t number_file_bytes(std::size_t numbers);

void write_number_file(FilePlace const& place, NumberFileKey const& key, std::span<double const> numbers);

// outdated: of this job, with another key. damaged: of this job, and not as it was written. foreign: not of this job,
// or no file of numbers at all
enum class NumberFile { whole, missing, outdated, damaged, foreign };

// fills `numbers` when it is whole, and may leave anything in them when it is not
NumberFile read_number_file(FilePlace const& place, NumberFileKey const& key, std::span<double> numbers);

// the job that an open file of numbers says it is of; nothing when it is none
std::optional<Sha256> number_file_identity(int descriptor);

}  // namespace torquescope
