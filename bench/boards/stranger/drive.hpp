#pragma once
// The drive: a digital loop that sees the encoder, and makes a torque of the path it should follow.
#include <string>

#include "stranger/rig.hpp"

namespace stranger {

struct LoopDesign {
  std::string kind;       // pd pid cascade stiff_spring
  double rate_hz = 4000;  // of the loop
  double bandwidth_hz = 4;
  double damping = 0.8;
  double speed_filter_hz = 150;
  double feedforward = 0;  // share of inertia, friction and weight that is fed forward
};

class Drive {
 public:
  Drive(LoopDesign design, Rig rig, double start);
  // torque for the next tick: where it should be (and was asked to be), what the encoder shows
  double tick(double wanted, double seen);

 private:
  LoopDesign design_;
  Rig rig_;
  double tick_s_, kp_, kd_, ki_;
  double seen_before_, wanted_before_, wanted_speed_ = 0, wanted_rate_ = 0, speed_ = 0, sum_ = 0;
};

}  // namespace stranger
