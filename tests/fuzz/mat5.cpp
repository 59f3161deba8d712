// Recordings in MATLAB files of level 5: engine/data/readers/mat5.cpp.
#include "tests/fuzz/hostile_reader.hpp"

namespace torquescope {

HostileReader const hostile_mat5{.read = [](std::string_view bytes) { read_recording("mat5", bytes); },
                                 .foreign = true};

}  // namespace torquescope
