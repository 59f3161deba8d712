// Losses of a gear that take one share of the load while the motor drives it and another while the load drives the
// motor.
//
// Equation   share = mean of both + (driving - driven)/2 tanh(s load / round); tau = s share |load| smoothed at no load
#include <cmath>

#include "concealed/effects/laws.hpp"

namespace concealed {
namespace {

class GearLosses final : public HiddenEffect {
 public:
  GearLosses(double driving, double driven, double round, Link const& link)
      : mean_(0.5 * (driving + driven)), half_(0.5 * (driving - driven)), round_(round), link_(link) {}
  double dry(Instant const& now, double const*) const override {
    double const load = link_.load(now), side = std::tanh(load / round_);
    return (mean_ + now.direction * half_ * side) * load * side;
  }
  bool feels_load() const override { return true; }

 private:
  double mean_, half_, round_;
  Link link_;
};

}  // namespace

Effect gear_losses(double driving, double driven, double round, Link const& link) {
  return std::make_shared<GearLosses>(driving, driven, round, link);
}

}  // namespace concealed
