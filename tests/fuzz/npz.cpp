// Arrays of numpy: engine/data/readers/npz.cpp.
#include "tests/fuzz/hostile_reader.hpp"

namespace torquescope {

HostileReader const hostile_npz{.read = [](std::string_view bytes) { read_recording("npz", bytes); }};

}  // namespace torquescope
