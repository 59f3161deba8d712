#pragma once
// Replicates of a recording: the fitted joint in the recording's own loop, with its reference, encoder and noise.
//
// Tick       the encoder reads position + position noise; the controller answers and holds its torque until the next
//            tick; torque noise is added to the log, disturbance to the joint; the dry friction level may walk
// Start      at the recording's first velocity, anywhere within the encoder step of its first position
// Encoder    where its steps lie is drawn for every replicate: else all share the recording's own rounding
// Groups     replicate_lanes replicates are simulated side by side; replicate i is lane i % replicate_lanes of group i
//            / replicate_lanes
// Random     addressed by (seed, recording, set, stream, replicate, draw): same bits on any number of threads and any
//            instruction set, whatever was simulated before; sets are independent
// Accuracy   second order in step_s, stops and reversals included (replicate_lanes.hpp)
// Units      SI
// Threads    const object, any number of threads, each with its own ReplicateGroup

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>

#include "engine/simulate/autoregression.hpp"
#include "engine/simulate/loop_controller.hpp"
#include "engine/simulate/replicate_joint.hpp"
#include "engine/simulate/sticking_range.hpp"

namespace torquescope {

// the loop round the joint; noise is whatever the recording's is
struct ReplicateLoop {
  LoopController controller{};
  double encoder_step = 0.0;           // rad or m; 0: exact
  Autoregression torque_noise{};       // of the measurement
  Autoregression slow_torque_noise{};  // the same, beside it
  // standard error of both their variances, as a share: every replicate draws a level of its own
  double torque_noise_variance_error = 0.0;
  double disturbance_std = 0.0;  // N m or N, white from tick to tick, acting on the joint
  // standard error of its square: every replicate draws its own level, so that the null holds this uncertainty
  double disturbance_variance_error = 0.0;
  double position_noise_std = 0.0;  // rad or m, before the encoder
  // the level of dry friction as a random walk: standard deviation of its change in one second, as a share of it; every
  // replicate draws a size of its own, as above
  double friction_wander = 0.0;
  double friction_wander_variance_error = 0.0;
  StickingRange sticking{};  // of dry friction: every replicate draws its own; none: it holds at once
  bool sees_motion = false;  // the controller answers the position itself, before the encoder's steps
};

// what the recording prescribes
struct ReplicateTrack {
  double rate_hz = 0.0;
  Eigen::VectorXd reference{};  // [n]
  double start_position = 0.0, start_velocity = 0.0;
  // a replicate that asks for more has run away
  double largest_torque = std::numeric_limits<double>::infinity();
  // [n] what the controller gives beside the joint's own torque, held, to an arm whose other joints move; empty:
  // nothing. The replicate's torque is without it, as that of a recording is
  Eigen::VectorXd gear_load{};
  Eigen::VectorXd fed_forward{};  // [n] torque that the controller adds to its answer; empty: none
};

struct ReplicateAddress {
  std::uint64_t seed = 0;
  std::uint32_t recording = 0;  // < 2^24
  std::uint32_t set = 0;        // < 2^29
};

// workspace and result of one group: measured channels as a recording has them
struct ReplicateGroup {
  std::array<Eigen::VectorXd, replicate_lanes> position{}, torque{};  // [n] each
  std::array<bool, replicate_lanes> ran_away{};
};

class ReplicateSimulator {
 public:
  // step_s: of effects with a memory; where nothing asks for it the steps are longer, a whole number of them per
  // tick
  ReplicateSimulator(ReplicateJoint joint, ReplicateLoop loop, ReplicateTrack track, double step_s);

  Eigen::Index samples() const { return track_.reference.size(); }
  ReplicateJoint const& joint() const { return joint_; }
  ReplicateLoop const& loop() const { return loop_; }
  ReplicateTrack const& track() const { return track_; }
  double step_s() const { return asked_step_s_; }
  void simulate(ReplicateAddress const& address, std::uint32_t group, ReplicateGroup& out) const;

 private:
  ReplicateJoint joint_;
  ReplicateLoop loop_;
  ReplicateTrack track_;
  double asked_step_s_ = 0.0, step_s_ = 0.0;
  std::size_t steps_per_tick_ = 0;
  Eigen::VectorXd open_;    // the controller's part that no replicate changes
  Eigen::VectorXd wanted_;  // reference seen by the summed error
};

}  // namespace torquescope
