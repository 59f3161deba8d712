// Dry friction of a guide or bearing that is tighter at some places than at others.
#include <cmath>

#include "concealed/effects/laws.hpp"

namespace concealed {
namespace {

class TightSpots final : public HiddenEffect {
 public:
  TightSpots(double amplitude, double order, double phase) : amplitude_(amplitude), order_(order), phase_(phase) {}
  double dry(Instant const& now, double const*) const override {
    double const x = order_ * now.q + phase_;
    return amplitude_ * (std::sin(x) + 0.35 * std::sin(2.0 * x + 1.1));
  }

 private:
  double amplitude_, order_, phase_;
};

}  // namespace

Effect tight_spots(double amplitude, double order, double phase) {
  return std::make_shared<TightSpots>(amplitude, order, phase);
}

}  // namespace concealed
