#pragma once
// The discrete position controller of a joint: one command per tick, held until the next.
//
// Equation   e = q_ref - q,  dq_hat = low-passed backward difference of q
//              p_velocity  u = kv (kp e - dq_hat)                     [feedforward: + kv dq_ref + J ddq_ref]
//              pd          u = kp e + kd (dq_ref - dq_hat)            [feedforward: + J ddq_ref]
//              pid         u = kp e + ki integral(e) + kd (dq_ref - dq_hat)   [feedforward: + J ddq_ref]
//            then |u| <= torque_limit; the integral stops where it would push further into the limit
// Gains      not given: from the inertia J and omega = 2 pi bandwidth_hz, poles of the frictionless joint all at
// -omega:
//              p_velocity  kp = omega / 2, kv = 2 J omega;   pd  kp = J omega^2, kd = 2 J omega
//              pid         kp = 3 J omega^2, kd = 3 J omega, ki = J omega^3
// Units      pd, pid: kp N m/rad, ki N m/(rad s), kd N m s/rad; p_velocity: kp 1/s, kv N m s/rad
// Source     p_velocity is the cascade of the EMPS benchmark (Janot, Gautier, Brunot 2019)

#include <deque>
#include <string>
#include <vector>

#include "engine/base/options.hpp"
#include "engine/simulate/reference.hpp"

namespace torquescope {

struct ControllerOptions {
  std::string kind = "p_velocity";
  double rate_hz = 0.0;
  double bandwidth_hz = 10.0;
  double kp = 0.0, kv = 0.0, kd = 0.0, ki = 0.0;
  double torque_limit = 0.0;
  double velocity_cutoff_hz = 100.0;
  bool feedforward = false;
  std::int64_t delay_ticks = 0;
  std::string torque_log = "applied";

  static OptionTable<ControllerOptions> const& table();
};

struct ControllerGains {
  double kp = 0.0, kv = 0.0, kd = 0.0, ki = 0.0;
};

// the rate in use: rate_hz, or the lowest multiple of the recording's rate from 1000 Hz on
double controller_rate_hz(ControllerOptions const& options, double recording_rate_hz);

// rates that do not divide, gains of another kind, half of the gains, a loop too fast for its tick
void check_controller(ControllerOptions const& options, double recording_rate_hz, Section const& section,
                      std::vector<Problem>& problems);

ControllerGains controller_gains(ControllerOptions const& options, double inertia);

class Controller {
 public:
  // `start`: the motion at the first tick, where the joint is taken to be on its reference
  Controller(ControllerOptions const& options, double rate_hz, double inertia, ReferencePoint const& start);

  // the torque the motor holds from this tick on: commanded delay_ticks ago. model_torque: what the motion needs, in
  // place of J ddq_ref
  double command(ReferencePoint const& reference, double measured_position);
  double command(ReferencePoint const& reference, double measured_position, double model_torque);
  ControllerGains const& gains() const { return gains_; }

 private:
  double measured_velocity(double position);
  double limited(double torque) const;
  double answer(ReferencePoint const& reference, double position, double velocity, double model_torque);

  ControllerOptions options_;
  double period_s_;
  double inertia_;
  ControllerGains gains_;
  double velocity_share_;  // of the newest difference in the low-pass
  double velocity_;
  double last_position_ = 0.0;
  bool has_last_position_ = false;
  double integral_ = 0.0;
  std::deque<double> delayed_;
};

}  // namespace torquescope
