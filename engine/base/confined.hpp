#pragma once
// Work on a file that nobody vouches for, in a child process: when a library crashes, loops or eats memory there, this
// process says so and lives on.
//
// Why        HDF5 1.10 and matio crash or loop on two damaged recordings in a hundred (measured: tests/hostile)
// Limits     processor seconds; memory beyond what the process has already (not under a sanitizer, which reserves all)
// Errors     an Error thrown by the work is thrown here, with all its problems; when the child ends in any other way,
//            Error{broke_off(how)}, how: "crashed (signal 11)", "took longer than 5 s", "ran out of memory"
// Threads    the child has one thread, whatever the parent has: the work must not wait for others. It leaves by _exit:
//            no exit handler of a library runs, no file of the parent is flushed

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "engine/base/error.hpp"

namespace torquescope {

struct ConfinedLimits {
  int processor_seconds = 5;
  std::uint64_t more_memory_bytes = std::uint64_t{10} << 30;
};

// for reading a file: far more than an honest one of its size takes, which is half a second per MiB
ConfinedLimits limits_for_file(std::filesystem::path const& file, int least_seconds);

// the bytes that the work returned
std::string run_confined(std::function<std::string()> const& work, ConfinedLimits const& limits,
                         std::function<Problem(std::string const& how)> const& broke_off);

}  // namespace torquescope
