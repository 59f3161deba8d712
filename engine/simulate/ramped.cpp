#include "engine/simulate/ramped.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
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

  ReferencePoint at(double time_s) const override { return ramped(time_s, oscillation_->at(time_s)); }

  void at_each(std::span<double const> times_s, ReferenceColumns const& points) const override {
    // both in a stretch that stays in the cache
    for (std::size_t first = 0; first < times_s.size(); first += times_together) {
      std::size_t const count = std::min(times_together, times_s.size() - first);
      auto const times = times_s.subspan(first, count);
      ReferenceColumns const block{points.q.subspan(first, count), points.dq.subspan(first, count),
                                   points.ddq.subspan(first, count)};
      oscillation_->at_each(times, block);
      for (std::size_t i = 0; i < count; ++i) block.set(i, ramped(times[i], {block.q[i], block.dq[i], block.ddq[i]}));
    }
  }

 private:
  static constexpr std::size_t times_together = 512;

  ReferencePoint ramped(double time_s, ReferencePoint const& p) const {
    if (ramp_s_ == 0.0 || time_s >= ramp_s_) return {centre_ + scale_ * p.q, scale_ * p.dq, scale_ * p.ddq};
    ReferencePoint w = smooth_step(time_s / ramp_s_);
    w.dq /= ramp_s_;
    w.ddq /= ramp_s_ * ramp_s_;
    return {centre_ + scale_ * (w.q * p.q), scale_ * (w.q * p.dq + w.dq * p.q),
            scale_ * (w.q * p.ddq + 2.0 * w.dq * p.dq + w.ddq * p.q)};
  }

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
  constexpr std::size_t points_together = 512;
  std::array<double, points_together> times_s, q, dq, ddq;
  ReferencePoint peak;
  for (double k = 0.0; k * step_s <= duration_s;) {
    std::size_t count = 0;
    for (; count < points_together && k * step_s <= duration_s; ++k) times_s[count++] = k * step_s;
    ReferenceColumns const points{std::span(q).first(count), std::span(dq).first(count), std::span(ddq).first(count)};
    motion->at_each(std::span(times_s).first(count), points);
    for (std::size_t i = 0; i < count; ++i) {
      peak.q = std::max(peak.q, std::abs(q[i]));
      peak.dq = std::max(peak.dq, std::abs(dq[i]));
      peak.ddq = std::max(peak.ddq, std::abs(ddq[i]));
    }
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
