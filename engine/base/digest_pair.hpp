#pragma once
// SHA-256 of two independent texts at once: each step of SHA-256 waits for the one before, so a second text costs a
// third.
//
// Speed      2.5 GB/s of both instead of 1.6 where the processor has instructions for SHA (x86-64); else one after the
//            other
// Threads    free function; does not allocate

#include <span>

#include "engine/base/digest.hpp"

namespace torquescope {

struct Sha256Pair {
  Sha256 first, second;
};

Sha256Pair sha256_of_two(std::span<std::byte const> first, std::span<std::byte const> second);

}  // namespace torquescope
