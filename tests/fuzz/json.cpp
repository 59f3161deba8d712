// Records and columns of JSON: engine/data/readers/json.cpp.
#include "tests/fuzz/hostile_reader.hpp"

namespace torquescope {

HostileReader const hostile_json{.read = [](std::string_view bytes) { read_recording("json", bytes); }};

}  // namespace torquescope
