#pragma once
// What the instruments make of the truth: steps of the encoder and of the converter that reads the motor current.

#include <cmath>
#include <numbers>

namespace concealed {

// nearest of 2^bits positions per turn; step 0: exact
class Encoder {
 public:
  static Encoder per_turn(int bits, double travel_per_turn) { return Encoder(travel_per_turn / std::exp2(bits)); }
  static Encoder ideal() { return Encoder(0.0); }
  double read(double position) const { return step_ > 0.0 ? step_ * std::round(position / step_) : position; }
  double step() const { return step_; }

 private:
  explicit Encoder(double step) : step_(step) {}
  double step_;
};

// nearest of 2^bits levels of -range ... range; bits 0: exact
class Converter {
 public:
  Converter(int bits, double range) : range_(range), step_(bits > 0 ? 2.0 * range / std::exp2(bits) : 0.0) {}
  double read(double value) const {
    if (step_ == 0.0) return value;
    return std::fmin(range_, std::fmax(-range_, step_ * std::round(value / step_)));
  }
  double step() const { return step_; }

 private:
  double range_, step_;
};

}  // namespace concealed
