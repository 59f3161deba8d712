// An encoder disc that is neither centred nor flat.
#include <cmath>

#include "concealed/instruments/faults.hpp"

namespace concealed {
namespace {

class EccentricDisc final : public Instrument {
 public:
  EccentricDisc(double error, double phase) : error_(error), phase_(phase) {}
  PositionError position(double q) const override {
    double const x = q + phase_, y = 2.0 * x + 0.8;
    return {error_ * (std::sin(x) + 0.25 * std::sin(y)), error_ * (std::cos(x) + 0.5 * std::cos(y)),
            -error_ * (std::sin(x) + std::sin(y))};
  }

 private:
  double error_, phase_;
};

}  // namespace

Fault eccentric_disc(double error, double phase) { return std::make_shared<EccentricDisc>(error, phase); }

}  // namespace concealed
