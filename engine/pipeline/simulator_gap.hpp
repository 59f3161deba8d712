#pragma once
// A recording against the user's own simulator: what is left of it once everything the simulator explains is gone.
//
// Equation   tau_sim = Y theta_sim + beyond        least squares on the recording's rows: what the model's terms can
//            say of
//                                                  the simulator, and what it holds beyond them (its own Stribeck,
//                                                  coupling)
//            recording.torque = tau - beyond       to be diagnosed in place of the recording
// Why        tau - tau_sim itself has lost the joint: where inertia and friction were, only their errors are left, so
//            no loop can be found in it, no twin simulated, no load torque known. tau - beyond keeps the joint, and on
//            the rows
//              residual(tau - beyond) = residual(tau - tau_sim)        what neither simulator nor wrong parameters
//              explain parameters(tau - tau_sim) = theta - theta_sim           the simulator's wrong parameters
//            up to what the filter carries over from rests and reversals, where beyond is bridged by a straight line
// Bias       both are least squares: the joint's carry the bias of noise, filter and held torques, the simulator's do
//            not (its torque follows from this very motion). With corrected parameters (baseline_correction.hpp) the
//            better errors are simulator_parameters minus those
// Noise      the simulator's torque carries the noise of the motion it was computed from; it stays in the recording,
//            and so counts as noise of the torque channel
// Requires   recording.simulated_torque; the pipeline of that recording
// Units      SI
// Errors     as RecordPipeline
// Threads    free function, plain record

#include <Eigen/Core>

#include "engine/pipeline/record_pipeline.hpp"

namespace torquescope {

struct SimulatorGap {
  Recording recording;                   // torque = tau - beyond; no simulated torque any more
  Eigen::VectorXd simulator_parameters;  // theta_sim, one per column of the regressor
  Eigen::VectorXd parameter_errors;      // theta_sim - theta: what to take away from the simulator's parameters
  double beyond_rms = 0.0;               // torque on the rows that no term can make
  double parameter_share = 0.0;          // of the energy of tau - tau_sim on the rows: wrong parameters
};

SimulatorGap gap_to_simulator(Recording const& recording, RecordPipeline const& pipeline);

}  // namespace torquescope
