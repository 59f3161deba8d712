#pragma once
// What a channel shows in place of the truth: faults of the torque channel and of the encoder.
//
// Torque     one call per tick; what the channel remembers is kept by the caller, n_memory() numbers that begin at 0
// Position   the reading is q + error(q); slope and bend are the first and second derivative of that error
// Units      SI of the joint: N m, rad or N, m
// Threads    const objects, any number of threads

#include <cstddef>
#include <memory>
#include <vector>

namespace concealed {

struct PositionError {
  double error = 0.0, slope = 0.0, bend = 0.0;
};

class Instrument {
 public:
  virtual ~Instrument() = default;
  virtual std::size_t n_memory() const { return 0; }
  virtual double torque(double /*t*/, double motor, double* /*memory*/) const { return motor; }
  virtual PositionError position(double /*q*/) const { return {}; }
};

using Instruments = std::vector<std::shared_ptr<Instrument const>>;

}  // namespace concealed
