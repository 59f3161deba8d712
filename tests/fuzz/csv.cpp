// Delimited text, plain or gzip: engine/data/readers/csv.cpp.
#include "tests/fuzz/hostile_reader.hpp"

namespace torquescope {

HostileReader const hostile_csv{.read = [](std::string_view bytes) { read_recording("csv", bytes); }};

}  // namespace torquescope
