// A load that is picked up in the middle of the record and kept.
#include <algorithm>

#include "concealed/effects/laws.hpp"

namespace concealed {
namespace {

constexpr double closing_s = 0.2;  // of the gripper

class PickedUpLoad final : public HiddenEffect {
 public:
  PickedUpLoad(double time_s, Link const& load) : time_s_(time_s), load_(load) {}
  double torque(Instant const& now, double const*) const override { return held(now.t) * load_.weight(now.q); }
  double added_inertia(Instant const& now) const override { return held(now.t) * load_.inertia; }

 private:
  double held(double t) const { return std::clamp((t - time_s_) / closing_s, 0.0, 1.0); }

  double time_s_;
  Link load_;
};

}  // namespace

Effect picked_up_load(double time_s, Link const& load) { return std::make_shared<PickedUpLoad>(time_s, load); }

}  // namespace concealed
