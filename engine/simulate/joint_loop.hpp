#pragma once
// What stands between a joint's position and its torque: encoder, controller and noise, tick by tick.
//
// At a tick  the encoder reads position + position noise; the controller answers; motor torque and disturbance are held
//            until the next tick
// A sample   torque noise is added to what is logged, not to what acts
// Units      SI
// Threads    one object, one thread

#include "engine/simulate/controller.hpp"
#include "engine/simulate/encoder.hpp"
#include "engine/simulate/noise.hpp"

namespace torquescope {

struct JointLoopOptions {
  ControllerOptions const& controller;
  EncoderOptions const& encoder;
  NoiseOptions const& noise;
  double controller_rate_hz, recording_rate_hz;
};

struct LoopTick {
  double measured;  // position
  double torque;    // the motor's
  double acting;    // and the disturbance
};

class JointLoop {
 public:
  // `inertia`: what gains are made from; `start`: the motion at the first tick
  JointLoop(JointLoopOptions const& options, RandomKey const& key, double inertia, ReferencePoint const& start);

  LoopTick tick(ReferencePoint const& wanted, double position, double model_torque);
  // once a sample, after its tick and before pass()
  double logged(LoopTick const& now);
  void pass(LoopTick const& now);  // on to the next tick
  bool is_saturated(LoopTick const& now) const;
  ControllerGains const& gains() const { return controller_.gains(); }

 private:
  bool averages_;
  double torque_limit_;
  Encoder encoder_;
  Controller controller_;
  ColouredNoise position_noise_, disturbance_, white_, coloured_;
  double torque_before_ = 0.0;
  bool has_begun_ = false;
};

}  // namespace torquescope
