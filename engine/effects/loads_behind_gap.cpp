#include "engine/effects/loads_behind_gap.hpp"

#include <cstddef>
#include <vector>

#include "kernels/dispatch-inl.hpp"

// the part up to HWY_ONCE is compiled once per instruction set
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/effects/loads_behind_gap.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#ifndef TORQUESCOPE_EFFECTS_LOADS_BEHIND_GAP
#define TORQUESCOPE_EFFECTS_LOADS_BEHIND_GAP
namespace torquescope::load_behind_gap {

inline constexpr std::size_t gap_lanes = 8;

// gap_lanes neighbours of each; event: 1 where contact begins or ends, and nothing was changed
struct GapLanes {
  double *y, *dy;
  double const *side, *now, *jerk;
  double* event;
};

}  // namespace torquescope::load_behind_gap
#endif

HWY_BEFORE_NAMESPACE();
namespace torquescope::load_behind_gap::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

namespace {

using D = hn::CappedTag<double, gap_lanes>;
using V = hn::Vec<D>;
inline constexpr D d;

HWY_INLINE V set(double value) { return hn::Set(d, value); }

struct Places {
  V y, dy;
};

// Flank::ring over a whole sub-step; the place relative to where the flank begins
HWY_INLINE Places rung(Flank const& flank, GapSubSteps const& steps, Places const& from, V now, V jerk) {
  V const per_square = set(flank.per_square()), decay = set(flank.decay()), ringing = set(flank.ringing());
  V const cosine = set(steps.fading.cosine), sine = set(steps.fading.sine);
  V const follow = hn::Add(hn::Mul(hn::Neg(now), per_square), hn::Mul(set(flank.lag()), jerk));
  V const dfollow = hn::Mul(hn::Neg(jerk), per_square);
  V const free = hn::Sub(from.y, follow), dfree = hn::Sub(from.dy, dfollow);
  V const quadrature = hn::Mul(hn::Add(dfree, hn::Mul(decay, free)), set(flank.per_ringing()));
  V const swing = hn::Add(hn::Mul(free, cosine), hn::Mul(quadrature, sine));
  V const dswing =
      hn::Sub(hn::Mul(dfree, cosine), hn::Mul(hn::Add(hn::Mul(free, ringing), hn::Mul(decay, quadrature)), sine));
  return {hn::Add(hn::Add(swing, follow), hn::Mul(dfollow, set(steps.time_s))), hn::Add(dswing, dfollow)};
}

// Grease::fly over a whole sub-step
HWY_INLINE Places flown(Grease const& grease, GapSubSteps const& steps, Places const& from, V now, V jerk) {
  V const time_s = set(steps.time_s);
  if (grease.is_thin(steps.time_s)) {
    V const half = set(0.5 * steps.time_s);
    V const mean = hn::Add(now, hn::Div(hn::Mul(jerk, time_s), set(3.0)));
    return {hn::Add(from.y, hn::Mul(time_s, hn::Sub(from.dy, hn::Mul(half, mean)))),
            hn::Sub(from.dy, hn::Mul(time_s, hn::Add(now, hn::Mul(half, jerk))))};
  }
  V const per_film = set(grease.per_film()), faded = set(steps.faded);
  V const change = hn::Mul(jerk, per_film), follow = hn::Mul(hn::Sub(change, now), per_film);
  V const lost = hn::Mul(hn::Sub(from.dy, follow), faded);
  V const drift = hn::Mul(time_s, hn::Sub(follow, hn::Mul(hn::Mul(set(0.5), change), time_s)));
  return {hn::Add(hn::Add(from.y, hn::Mul(lost, per_film)), drift),
          hn::Sub(hn::Sub(from.dy, lost), hn::Mul(change, time_s))};
}

// LoadBehindGap::side_at
HWY_INLINE V side_at(Flank const& flank, V half_gap, Places const& at) {
  V const side = hn::CopySign(set(1.0), at.y), zero = hn::Zero(d);
  V const beyond = hn::Sub(at.y, hn::Mul(side, half_gap));
  V const push = hn::Add(hn::Mul(set(flank.omega() * flank.omega()), beyond), hn::Mul(set(flank.push_per_s()), at.dy));
  return hn::IfThenElseZero(hn::And(hn::Gt(hn::Mul(side, beyond), zero), hn::Gt(hn::Mul(side, push), zero)), side);
}

}  // namespace

// whether there was any event
bool whole_sub_step(LoadBehindGap const& law, GapLanes const& lanes) {
  V const half_gap = set(law.half_gap());
  bool any = false;
  for (std::size_t k = 0; k < gap_lanes; k += hn::MaxLanes(d)) {
    Places const at{hn::LoadU(d, lanes.y + k), hn::LoadU(d, lanes.dy + k)};
    V const side = hn::LoadU(d, lanes.side + k), now = hn::LoadU(d, lanes.now + k), jerk = hn::LoadU(d, lanes.jerk + k);
    V const gap = hn::Mul(side, half_gap);
    auto const flies = hn::Eq(side, hn::Zero(d));
    Places next = at;
    if (!hn::AllTrue(d, flies)) {
      next = rung(law.flank(), law.sub_steps(), {hn::Sub(at.y, gap), at.dy}, now, jerk);
      next.y = hn::Add(next.y, gap);
    }
    if (!hn::AllFalse(d, flies)) {
      Places const in_gap = flown(law.grease(), law.sub_steps(), at, now, jerk);
      next = {hn::IfThenElse(flies, in_gap.y, next.y), hn::IfThenElse(flies, in_gap.dy, next.dy)};
    }
    auto const stays = hn::Eq(side_at(law.flank(), half_gap, next), side);
    hn::StoreU(hn::IfThenElse(stays, next.y, at.y), d, lanes.y + k);
    hn::StoreU(hn::IfThenElse(stays, next.dy, at.dy), d, lanes.dy + k);
    hn::StoreU(hn::IfThenElse(stays, hn::Zero(d), set(1.0)), d, lanes.event + k);
    any = any || !hn::AllTrue(d, stays);
  }
  return any;
}

}  // namespace torquescope::load_behind_gap::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace torquescope::load_behind_gap {
namespace {

TORQUESCOPE_EXPORT(whole_sub_step);

class LoadsBehindGap final : public EffectMemory {
 public:
  LoadsBehindGap(LoadBehindGap const& fresh, std::size_t lanes)
      : law_(fresh), n_(lanes), weight_(n_), cosine_(n_), sine_(n_), drive_(n_) {
    std::size_t const whole = (lanes + gap_lanes - 1) / gap_lanes * gap_lanes;
    for (auto* one : {&y_, &dy_, &side_, &now_, &jerk_, &event_}) one->assign(whole, 0.0);
  }

  // lanes of one shape are for twins: one lane by itself is none of these
  void append(EffectMemory const&) override { TORQUESCOPE_EXPECT(false); }
  void columns(EffectInput const&, Eigen::Ref<Eigen::MatrixXd>) override { TORQUESCOPE_EXPECT(false); }

  void advance(JointStates const& at, double step_s) override {
    if (!has_started_) return start(at);
    law_.divide(step_s);
    double const part_s = law_.sub_steps().time_s;
    if (law_.has_weight()) {
      kernels::cosine_sine_of_multiple(1.0, at.q.data(), n_, cosine_.data(), sine_.data());
      for (std::size_t lane = 0; lane < n_; ++lane) weight_[lane] = law_.weight(cosine_[lane], sine_[lane]);
    }
    for (std::size_t lane = 0; lane < n_; ++lane) {
      double const end = law_.drive_of(at.state(lane), weight_[lane]);
      now_[lane] = drive_[lane];
      jerk_[lane] = (end - drive_[lane]) / step_s;
      drive_[lane] = end;
    }
    auto const sub_step = TORQUESCOPE_DISPATCH(whole_sub_step);
    for (int i = 0; i < law_.sub_steps().count; ++i) {
      for (std::size_t k = 0; k < y_.size(); k += gap_lanes)
        if (sub_step(law_, {&y_[k], &dy_[k], &side_[k], &now_[k], &jerk_[k], &event_[k]})) meet_events(k);
      for (std::size_t lane = 0; lane < n_; ++lane) now_[lane] = Drive{now_[lane], jerk_[lane]}.after(part_s).now;
    }
  }

  void torques(JointStates const& at, std::span<double const> linear, std::span<double> out) const override {
    TORQUESCOPE_EXPECT(linear.size() == 1 && out.size() == n_);
    for (std::size_t lane = 0; lane < n_; ++lane)
      out[lane] =
          0.0 + linear[0] * (law_.push(place(lane), side_[lane]) - law_.drive_of(at.state(lane), weight_[lane]));
  }

 private:
  void start(JointStates const& at) {
    has_started_ = true;
    for (std::size_t lane = 0; lane < n_; ++lane) {
      law_.start(at.state(lane));
      take(lane);
      weight_[lane] = law_.load().weight;
      drive_[lane] = law_.load().drive;
    }
  }

  Place place(std::size_t lane) const { return {y_[lane], dy_[lane]}; }

  void take(std::size_t lane) {
    y_[lane] = law_.load().at.y;
    dy_[lane] = law_.load().at.dy;
    side_[lane] = law_.load().side;
  }

  // one load after the other: few at a time meet a flank
  void meet_events(std::size_t first) {
    for (std::size_t lane = first; lane < first + gap_lanes; ++lane) {
      if (event_[lane] == 0.0) continue;
      law_.put({place(lane), side_[lane], weight_[lane], drive_[lane]});
      law_.sub_step({now_[lane], jerk_[lane]});
      take(lane);
    }
  }

  LoadBehindGap law_;
  std::size_t n_;
  std::vector<double> weight_, cosine_, sine_, drive_;
  std::vector<double> y_, dy_, side_, now_, jerk_, event_;  // whole vectors: lanes behind the last never meet a flank
  bool has_started_ = false;
};

}  // namespace

std::unique_ptr<EffectMemory> loads_behind_gap(LoadBehindGap const& fresh, std::size_t lanes) {
  if (lanes == 1) return memory_of(fresh, 1);
  return std::make_unique<LoadsBehindGap>(fresh, lanes);
}

}  // namespace torquescope::load_behind_gap
#endif  // HWY_ONCE
