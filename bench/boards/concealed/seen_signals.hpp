#pragma once
// The instruments of a rig one behind the other: what the channels show, and how much torque each of them fakes.
//
// Torque     passes through the instruments in their order
// Position   errors add up
// Threads    one object, one run

#include <vector>

#include "concealed/instrument.hpp"
#include "concealed/plant.hpp"

namespace concealed {

class SeenSignals {
 public:
  explicit SeenSignals(Instruments const& instruments);

  // once per tick, when it begins; remembers what each instrument made of it
  double torque(double t, double motor);
  double position(double q) const;

  struct Motion {
    double q = 0.0, v = 0.0, a = 0.0;
  };
  Motion motion(Motion const& truth) const;
  // torque the model of this joint misses because of instrument `index`, after the last call of torque()
  double faked(std::size_t index, Baseline const& baseline, Motion const& truth) const;

 private:
  static Motion shifted(Motion const& truth, PositionError const& error);

  Instruments const& instruments_;
  std::vector<std::vector<double>> memory_;
  std::vector<double> change_;  // of the torque, by each instrument
};

}  // namespace concealed
