#pragma once
// Text of a small job that brings its own recording: five seconds of a joint by inverse dynamics.

#include <string>

#include "engine/workflows/workflows.hpp"
#include "support/temporary_folder.hpp"

namespace torquescope::test {

inline std::string const simulated_joint = R"(
[simulate]
mode = "inverse_dynamics"
rate_hz = 200
duration_s = 5
[simulate.plant]
inertia = 0.5
viscous = 0.2
coulomb = 0.1
)";

// of that joint: inertia, friction and an offset that is 0
inline std::string const joint_model = R"(
[model]
terms = ["inertia", "viscous", "coulomb", "offset"]
)";

// as if the text stood in a file; Errors: those of Experiment::load
inline Experiment load_job(std::string const& text, Experiment::Purpose purpose = Experiment::Purpose::identify) {
  TemporaryFolder const folder;
  return Experiment::load(folder.write("job.toml", text), purpose);
}

}  // namespace torquescope::test
