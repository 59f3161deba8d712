#include "engine/simulate/ramped.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/base/contract.hpp"
#include "engine/simulate/turns.hpp"

namespace torquescope {

namespace {

// the smooth step w(x) and its first two derivatives
ReferencePoint smooth_step(double x) {
  if (x <= 0.0) return {};
  if (x >= 1.0) return {1.0, 0.0, 0.0};
  return {x * x * x * (10.0 - x * (15.0 - 6.0 * x)), 30.0 * x * x * (1.0 - x) * (1.0 - x),
          60.0 * x * (1.0 - x) * (1.0 - 2.0 * x)};
}

class Ramped : public Reference {
 public:
  Ramped(std::unique_ptr<Reference const> oscillation, double ramp_s)
      : oscillation_(std::move(oscillation)), ramp_s_(ramp_s) {}

  void rescale(double centre, double scale) {
    centre_ = centre;
    scale_ = scale;
  }

  ReferencePoint at(double time_s) const override {
    ReferencePoint w{1.0, 0.0, 0.0};
    if (ramp_s_ > 0.0) {
      w = smooth_step(time_s / ramp_s_);
      w.dq /= ramp_s_;
      w.ddq /= ramp_s_ * ramp_s_;
    }
    ReferencePoint const p = oscillation_->at(time_s);
    return {centre_ + scale_ * (w.q * p.q), scale_ * (w.q * p.dq + w.dq * p.q),
            scale_ * (w.q * p.ddq + 2.0 * w.dq * p.dq + w.ddq * p.q)};
  }

 private:
  std::unique_ptr<Reference const> oscillation_;
  double ramp_s_;
  double centre_ = 0.0;
  double scale_ = 1.0;
};

}  // namespace

std::unique_ptr<Reference const> ramped_to_limits(std::unique_ptr<Reference const> oscillation, double highest_hz,
                                                  double duration_s, ReferenceOptions const& options) {
  auto motion = std::make_unique<Ramped>(std::move(oscillation), options.ramp_s);

  // peaks of the unscaled motion
  constexpr double points_per_period = 128.0;
  double const step_s = 1.0 / (points_per_period * highest_hz);
  ReferencePoint peak;
  for (double k = 0.0; k * step_s <= duration_s; ++k) {
    ReferencePoint const point = motion->at(k * step_s);
    peak.q = std::max(peak.q, std::abs(point.q));
    peak.dq = std::max(peak.dq, std::abs(point.dq));
    peak.ddq = std::max(peak.ddq, std::abs(point.ddq));
  }
  TORQUESCOPE_EXPECT(peak.q > 0.0 && peak.dq > 0.0 && peak.ddq > 0.0);

  // a band-limited function exceeds its samples by at most 1 / cos(pi / points per period)
  double const between_points = cosine_of_turns(0.5 / points_per_period);
  double const scale = between_points * std::min({options.amplitude / peak.q, options.max_speed / peak.dq,
                                                  options.max_acceleration / peak.ddq});
  motion->rescale(options.centre, scale);
  return motion;
}

}  // namespace torquescope
