#pragma once
// The digital position loop: one command per tick from the encoder's reading, applied one tick later and then held.
//
// Equation   e = reference - reading; slope(x) = slope of the straight line through the last `fir_length` values of x
//            pd       u = kp e + kd slope(e)
//            pid      u = kp e + ki sum(e) tick + kd slope(e)
//            cascade  w = kp e + slope(reference) - slope(reading);  u = kv w + ki sum(w) tick
//            with feedforward  u + inertia bend(reference) + viscous slope(reference)
//                                + coulomb tanh(slope(reference) / knee), bend: last change of the slope per tick
//            |u| <= torque_limit; the sums stop while u is limited
// Gains      from the joint's inertia J and omega = 2 pi bandwidth_hz, see controller.cpp
// Units      SI of the joint

#include <deque>
#include <string>

namespace concealed {

enum class Law { pd, pid, cascade };
std::string to_text(Law law);

struct Feedforward {
  double inertia = 0.0, viscous = 0.0, coulomb = 0.0, knee = 1.0;
};

struct ControllerDesign {
  std::string name;
  Law law = Law::pd;
  double bandwidth_hz = 8.0;
  int fir_length = 3;
  Feedforward feedforward = {};
};

class Controller {
 public:
  Controller(ControllerDesign const& design, double inertia, double torque_limit, double tick_s);
  double command(double reference, double reading);

 private:
  double slope(std::deque<double> const& values) const;
  void remember(std::deque<double>& values, double value) const;
  double limited(double u) const;
  double ahead(double reference_slope);

  ControllerDesign design_;
  double tick_s_, torque_limit_;
  double kp_ = 0.0, ki_ = 0.0, kd_ = 0.0, kv_ = 0.0;
  double sum_ = 0.0, last_slope_ = 0.0;
  std::deque<double> references_, readings_;
};

}  // namespace concealed
