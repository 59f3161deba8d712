// Dry friction that grows with what the gear transmits to the link, rounded near zero load.
#include <cmath>

#include "concealed/effects/laws.hpp"

namespace concealed {
namespace {

class LoadFriction final : public HiddenEffect {
 public:
  LoadFriction(double share, double round, Link const& link) : share_(share), round_(round), link_(link) {}
  double dry(Instant const& now, double const*) const override {
    double const load = link_.load(now);
    return share_ * (std::sqrt(load * load + round_ * round_) - round_);
  }
  bool feels_load() const override { return true; }

 private:
  double share_, round_;
  Link link_;
};

}  // namespace

Effect load_friction(double share, double round, Link const& link) {
  return std::make_shared<LoadFriction>(share, round, link);
}

}  // namespace concealed
