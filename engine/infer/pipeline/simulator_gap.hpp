#pragma once
// A recording less what the user's own simulator explains of it (METHOD.md, Comparison with a simulator).
//
// Equation   tau_sim = Y theta_sim + beyond, least squares on the recording's rows; recording.torque = tau - beyond
//            residual(tau - beyond) = residual(tau - tau_sim), parameters(tau - tau_sim) = theta - theta_sim,
//            up to what the filter carries over from rests and reversals, where `beyond` is bridged by a straight line
// Bias       the joint's parameters carry the bias of noise, filter and held torque; the simulator's do not
// Noise      the simulator's torque carries the noise of its motion; it counts as noise of the torque channel
// Load       `beyond` passes the gear all the same: recording.gear_load, for effects that follow the load
// Requires   recording.simulated_torque; the pipeline of that recording
// Units      SI
// Errors     as RecordPipeline
// Threads    free function, plain record

#include <Eigen/Core>

#include "engine/infer/pipeline/record_pipeline.hpp"

namespace torquescope {

struct SimulatorGap {
  Recording recording;                   // torque = tau - beyond; no simulated torque any more
  Eigen::VectorXd simulator_parameters;  // theta_sim, one per column of the regressor
  Eigen::VectorXd parameter_errors;      // theta_sim - theta: what to take away from the simulator's parameters
  double beyond_rms = 0.0;               // torque on the rows that no term can make
  double parameter_share = 0.0;          // of the energy of tau - tau_sim on the rows: wrong parameters
};

SimulatorGap gap_to_simulator(Recording const& recording, RecordPipeline const& pipeline);

// Where the joint rests or turns the sign of a noisy velocity says nothing about friction, and two models chatter, each
// in its own way: straight from the last sample before such a stretch to the first one after it
Eigen::VectorXd bridged_over_rests(Eigen::VectorXd torque, Eigen::VectorXd const& dq, double rate_hz);

// another recording, told apart by the parameters of the training recording's gap; as it is without a simulated torque
// pipeline: of that recording, without effects
Recording without_simulator(Recording recording, RecordPipeline const& pipeline,
                            Eigen::VectorXd const& simulator_parameters);

}  // namespace torquescope
