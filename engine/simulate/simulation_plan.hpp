#pragma once
// The [simulate] part of a job, read and checked: everything simulate_joint() needs but the seed.
//
// Errors     read_simulation collects Problems (exit code 78), all at once; use the plan only when there are none

#include <cstdint>
#include <string>
#include <vector>

#include "engine/base/options.hpp"
#include "engine/simulate/controller.hpp"
#include "engine/simulate/encoder.hpp"
#include "engine/simulate/joint_plant.hpp"
#include "engine/simulate/noise.hpp"
#include "engine/simulate/reference.hpp"

namespace torquescope {

struct SimulationOptions {
  std::string mode = "closed_loop";
  double rate_hz = 1000.0;
  double duration_s = 10.0;
  double step_s = 20e-6;
  bool validate = true;
  std::int64_t seed = -1;

  static OptionTable<SimulationOptions> const& table();
  std::int64_t samples() const;  // of one recording: the nearest whole number of duration_s * rate_hz
};

struct SimulationPlan {
  JointKind joint = JointKind::revolute;
  SimulationOptions simulation{};
  std::vector<PlantTerm> plant{};
  ReferenceOptions reference{};
  ControllerOptions controller{};  // this and the encoder: mode "closed_loop" only
  EncoderOptions encoder{};
  NoiseOptions noise{};
};

// the sections of the same names in a job; those that were not written are null
struct SimulationSections {
  Section const* simulate = nullptr;
  Section const* plant = nullptr;
  Section const* reference = nullptr;
  Section const* controller = nullptr;
  Section const* encoder = nullptr;
  Section const* noise = nullptr;
};

// a section that was not written: its problems point to [simulate]
Section written_or_empty(Section const* section, Section const* simulate, std::string const& name);
// sections and keys that have no effect in mode "inverse_dynamics"
void refuse_loop_sections(SimulationSections const& sections, std::vector<Problem>& problems);
// too few samples for so many parameters, or more than memory has
void check_samples(SimulationOptions const& simulation, std::size_t unknowns, Section const& simulate,
                   std::vector<Problem>& problems);

SimulationPlan read_simulation(SimulationSections const& sections, JointKind joint, std::vector<Problem>& problems);

}  // namespace torquescope
