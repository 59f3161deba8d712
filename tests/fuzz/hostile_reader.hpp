#pragma once
// What is thrown at each reader of files that nobody vouches for: one object per format, a file of its name each.
//
// Effect        `read` returns or throws an Error, whatever the bytes are; a crash, a hang, any other exception is a
//            finding
// Used by    short_pass.cpp (every build; scripts/test) and lib_fuzzer.cpp (preset fuzz; scripts/test --full)
// Threads    one

#include <cstdint>
#include <span>
#include <string_view>

namespace torquescope {

struct HostileReader {
  void (*read)(std::string_view bytes);  // in this process
  // makes checksums right again that a change has broken, or nothing behind them is ever reached; may be missing
  void (*mend)(std::span<std::uint8_t> bytes) = nullptr;
  bool foreign = false;  // a library of others parses it, which is known to crash: the program reads it in a child
};

extern HostileReader const hostile_job, hostile_csv, hostile_hdf5, hostile_json, hostile_mat5, hostile_npz,
    hostile_ros_echo, hostile_segment;

// the recording reader of that name
void read_recording(char const* reader, std::string_view bytes);

}  // namespace torquescope
