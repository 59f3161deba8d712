#pragma once
// A recording of an arm whose parameters are known: the same two modes as of a joint (joint_simulation.hpp), all joints
// on one clock.
//
// closed_loop       each joint has its controller, encoder and noise; the arm moves as one (arm_plant.hpp). feedforward
//                   of a controller: the torque that the whole arm needs on its reference (computed torque)
// inverse_dynamics  every joint is exactly on its reference; torque = that of the model + noise
//
// Shapes     one SimulatedRecording a joint, of equal lengths
// Promise    the same plan, seed and index give the same bits, whatever was simulated before and on how many threads;
//            noise of joint j has the key of recording index + 4096 j
// Errors     Error 78 when the loop runs away, or an arm of these parameters has no mass somewhere
// Threads    call it from any number of threads

#include <cstdint>
#include <string>
#include <vector>

#include "engine/simulate/arm_plant.hpp"
#include "engine/simulate/joint_simulation.hpp"
#include "engine/simulate/sampled_reference.hpp"

namespace torquescope {

// what one joint has of its own
struct ArmJointPlan {
  ArmJointTerms terms{};
  ReferenceOptions reference{};
  ControllerOptions controller{};
  EncoderOptions encoder{};
  NoiseOptions noise{};
};

struct ArmSimulationPlan {
  SerialChain chain{};  // with inertias
  SimulationOptions simulation{};
  std::vector<ArmJointPlan> joints{};
  // motions from files, one entry a recording and in it one a joint; none: the references of the joints
  std::vector<std::vector<SampledMotion>> motions{};
};

struct SimulatedArm {
  std::string name;    // "simulated", "simulated_unseen"
  std::string sha256;  // of all joints
  std::vector<SimulatedRecording> joints;
};

SimulatedArm simulate_arm(ArmSimulationPlan const& plan, std::uint64_t experiment_seed, std::uint32_t index = 0);

// as columns() names them, with the joint's number from 1: "q2_rad", "tau2_Nm"; time once
std::vector<SimulatedColumn> columns(SimulatedArm const& arm);

// base parameters with drive inertias ("xxr2"), then what the effects of joint j are made of ("viscous_2")
std::vector<TruthValue> truth_values(ArmSimulationPlan const& plan);

}  // namespace torquescope
