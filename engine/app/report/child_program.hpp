#pragma once
// Runs a program and waits for it: it cannot outlive this process, nor spin for ever.
//
// Why        OpenBLAS, which numpy loads, asks again and again for memory that a limit (ulimit -v) refuses it
// Set        OPENBLAS_NUM_THREADS=1, so that it asks for one thread's share: pages need no more
// Errors     none thrown: how it ended is returned
// Threads    called from the main thread: the program is killed when the thread that started it ends

#include <optional>
#include <string>
#include <vector>

namespace torquescope {

enum class Voice { heard, silent };  // heard: its stdout is our stderr, for our stdout belongs to our own results

struct ProgramEnd {
  std::optional<int> status{};    // nothing: it could not be started or died of a signal; 127: it is not there
  bool used_up_its_time = false;  // of the processor
};

ProgramEnd run_program(std::vector<std::string> arguments, Voice voice, int processor_seconds);

}  // namespace torquescope
