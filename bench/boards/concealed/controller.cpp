#include "concealed/controller.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace concealed {

std::string to_text(Law law) {
  switch (law) {
    case Law::pd:
      return "pd";
    case Law::pid:
      return "pid";
    case Law::cascade:
      break;
  }
  return "cascade";
}

Controller::Controller(ControllerDesign const& design, double inertia, double torque_limit, double tick_s)
    : design_(design), tick_s_(tick_s), torque_limit_(torque_limit) {
  double const omega = 2.0 * std::numbers::pi * design.bandwidth_hz;
  switch (design.law) {
    case Law::pd:  // damping 0.9
      kp_ = inertia * omega * omega;
      kd_ = 1.8 * inertia * omega;
      break;
    case Law::pid:  // as pd, integral time eight radians of the loop
      kp_ = inertia * omega * omega;
      kd_ = 1.8 * inertia * omega;
      ki_ = kp_ * omega / 8.0;
      break;
    case Law::cascade:  // position loop at a third of the speed loop, its integral at a sixth
      kp_ = omega / 3.0;
      kv_ = 1.6 * inertia * omega;
      ki_ = kv_ * omega / 6.0;
      break;
  }
}

void Controller::remember(std::deque<double>& values, double value) const {
  // before the first tick the joint stood still where it is now
  if (values.empty()) values.assign(static_cast<std::size_t>(design_.fir_length), value);
  values.pop_front();
  values.push_back(value);
}

double Controller::slope(std::deque<double> const& values) const {
  double const centre = 0.5 * (design_.fir_length - 1);
  double up = 0.0, down = 0.0, place = -centre;
  for (double value : values) {
    up += place * value;
    down += place * place;
    place += 1.0;
  }
  return up / (down * tick_s_);
}

double Controller::limited(double u) const { return std::clamp(u, -torque_limit_, torque_limit_); }

double Controller::ahead(double reference_slope) {
  Feedforward const& known = design_.feedforward;
  double const bend = (reference_slope - last_slope_) / tick_s_;
  last_slope_ = reference_slope;
  return known.inertia * bend + known.viscous * reference_slope +
         known.coulomb * std::tanh(reference_slope / known.knee);
}

double Controller::command(double reference, double reading) {
  remember(references_, reference);
  remember(readings_, reading);
  double const e = reference - reading;
  double const reference_slope = slope(references_);
  double const e_slope = reference_slope - slope(readings_);
  double const input = design_.law == Law::cascade ? kp_ * e + e_slope : e;
  double const direct = design_.law == Law::cascade ? kv_ * input : kp_ * e + kd_ * e_slope;
  double const u = direct + ki_ * (sum_ + input * tick_s_) + ahead(reference_slope);
  if (std::abs(u) < torque_limit_) sum_ += input * tick_s_;
  return limited(u);
}

}  // namespace concealed
