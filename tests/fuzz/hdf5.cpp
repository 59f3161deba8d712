// Recordings in HDF5 and MATLAB 7.3: engine/data/readers/hdf5.cpp.
#include "tests/fuzz/hostile_reader.hpp"

namespace torquescope {

HostileReader const hostile_hdf5{.read = [](std::string_view bytes) { read_recording("hdf5", bytes); },
                                 .foreign = true};

}  // namespace torquescope
