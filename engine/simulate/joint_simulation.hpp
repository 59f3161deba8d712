#pragma once
// A recording of a joint whose parameters are known.
//
// closed_loop       reference -> controller -> joint with stick and slip -> encoder -> controller; torque as logged +
// noise inverse_dynamics  the reference is the motion, exactly; torque = Phi a + noise
//
// Shapes     every vector: plan.simulation.samples() entries; sample i is at i / rate_hz
// Units      SI; see columns()
// Promise    the same plan, seed and index give the same bits, whatever was simulated before and on how many threads
// Errors     Error 78 when the loop runs away
// Threads    call it from any number of threads

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "engine/simulate/plant_parameters.hpp"
#include "engine/simulate/simulation_plan.hpp"

namespace torquescope {

struct SimulatedRecording {
  std::string name;    // "simulated", "simulated_unseen"
  std::string sha256;  // of rate, number of samples and channels; by blocks (base/digest_batch.hpp)
  JointKind joint = JointKind::revolute;
  double rate_hz = 0.0;
  // inverse_dynamics: velocity and acceleration are channels of the recording; reference and true_position are the
  // position and stay empty
  bool has_exact_motion = false;
  Eigen::VectorXd time_s, reference;
  Eigen::VectorXd position;  // as measured
  Eigen::VectorXd torque;    // as measured
  // what nobody could measure: the plant's state at the sample; acceleration, and the torque that acts (motor and
  // disturbance), just after it
  Eigen::VectorXd true_position, true_velocity, true_acceleration, true_torque;
  std::vector<TruthValue> truth;
  // closed_loop only
  ControllerGains gains{};
  double controller_rate_hz = 0.0;
  Eigen::Index saturated_samples = 0;  // |torque| at the motor's limit
};

// index 0 is the recording to learn from, 1 the validation one (plan.simulation.validate)
// true_torque may stay empty, for who has no use for it: 8 bytes per sample
enum class TrueTorque { kept, left_out };
SimulatedRecording simulate_joint(SimulationPlan const& plan, std::uint64_t experiment_seed, std::uint32_t index = 0,
                                  TrueTorque truth = TrueTorque::kept);

// of what a job can see: rate, number of samples (both say the time) and every channel
std::string digest_of(SimulatedRecording const& recording);

struct SimulatedColumn {
  std::string name;     // "q_rad"
  std::string unit;     // "rad"
  std::string channel;  // key of recording.columns: "position"; empty for the truth
  Eigen::VectorXd const* values;
};
// in the order of a file; points into the recording
std::vector<SimulatedColumn> columns(SimulatedRecording const& recording);

}  // namespace torquescope
