#include "engine/effects/gap_lanes.hpp"

#include "kernels/dispatch-inl.hpp"

// the part up to HWY_ONCE is compiled once per instruction set
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/effects/gap_lanes.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace torquescope::load_behind_gap::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

namespace {

using D = hn::CappedTag<double, gap_lanes>;
using V = hn::Vec<D>;
inline constexpr D d;

HWY_INLINE V set(double value) { return hn::Set(d, value); }
HWY_INLINE V of(Eight const& values, std::size_t lane) { return hn::LoadU(d, values.data() + lane); }

HWY_INLINE V of(double const* values, bool is_common, std::size_t lane) {
  return is_common ? set(*values) : hn::LoadU(d, values + lane);
}

// LoadBehindGap::drive_of
HWY_INLINE V drive_of(EightGaps const& gaps, EightLoads const& loads, Motions const& at, std::size_t k) {
  V const pulled = hn::Add(of(at.ddq, at.is_common, k), of(loads.weight, k));
  return hn::Add(pulled, hn::Mul(of(gaps.drag_per_s, k), of(at.dq, at.is_common, k)));
}

// DryFriction::against
HWY_INLINE V dry_against(EightGaps const& gaps, std::size_t k, V slides) {
  V const zero = hn::Zero(d);
  V const backward = hn::IfThenElseZero(hn::Lt(slides, zero), hn::Neg(of(gaps.backward, k)));
  return hn::IfThenElse(hn::Gt(slides, zero), of(gaps.forward, k), backward);
}

struct Places {
  V y, dy;
};

// Flank::ring over a whole sub-step; the place relative to where the flank begins
HWY_INLINE Places rung(EightGaps const& gaps, EightSubSteps const& steps, std::size_t k, Places const& from, V now,
                       V jerk) {
  V const per_square = of(gaps.per_square, k), decay = of(gaps.decay, k), ringing = of(gaps.ringing, k);
  V const cosine = of(steps.cosine, k), sine = of(steps.sine, k);
  V const follow = hn::Add(hn::Mul(hn::Neg(now), per_square), hn::Mul(of(gaps.lag, k), jerk));
  V const dfollow = hn::Mul(hn::Neg(jerk), per_square);
  V const free = hn::Sub(from.y, follow), dfree = hn::Sub(from.dy, dfollow);
  V const quadrature = hn::Mul(hn::Add(dfree, hn::Mul(decay, free)), of(gaps.per_ringing, k));
  V const swing = hn::Add(hn::Mul(free, cosine), hn::Mul(quadrature, sine));
  V const dswing =
      hn::Sub(hn::Mul(dfree, cosine), hn::Mul(hn::Add(hn::Mul(free, ringing), hn::Mul(decay, quadrature)), sine));
  return {hn::Add(hn::Add(swing, follow), hn::Mul(dfollow, of(steps.time_s, k))), hn::Add(dswing, dfollow)};
}

// Grease::fly over a whole sub-step
HWY_INLINE Places flown_thinly(V time_s, Places const& from, V now, V jerk) {
  V const half = hn::Mul(set(0.5), time_s);
  V const mean = hn::Add(now, hn::Div(hn::Mul(jerk, time_s), set(3.0)));
  return {hn::Add(from.y, hn::Mul(time_s, hn::Sub(from.dy, hn::Mul(half, mean)))),
          hn::Sub(from.dy, hn::Mul(time_s, hn::Add(now, hn::Mul(half, jerk))))};
}

HWY_INLINE Places flown_thickly(V time_s, V per_film, V faded, Places const& from, V now, V jerk) {
  V const change = hn::Mul(jerk, per_film), follow = hn::Mul(hn::Sub(change, now), per_film);
  V const lost = hn::Mul(hn::Sub(from.dy, follow), faded);
  V const drift = hn::Mul(time_s, hn::Sub(follow, hn::Mul(hn::Mul(set(0.5), change), time_s)));
  return {hn::Add(hn::Add(from.y, hn::Mul(lost, per_film)), drift),
          hn::Sub(hn::Sub(from.dy, lost), hn::Mul(change, time_s))};
}

HWY_INLINE Places flown(EightGaps const& gaps, EightSubSteps const& steps, std::size_t k, Places const& from, V now,
                        V jerk) {
  V const time_s = of(steps.time_s, k);
  auto const is_thin = hn::Gt(of(steps.is_thin, k), hn::Zero(d));
  if (hn::AllTrue(d, is_thin)) return flown_thinly(time_s, from, now, jerk);
  Places const thick = flown_thickly(time_s, of(gaps.per_film, k), of(steps.faded, k), from, now, jerk);
  if (hn::AllFalse(d, is_thin)) return thick;
  Places const thin = flown_thinly(time_s, from, now, jerk);
  return {hn::IfThenElse(is_thin, thin.y, thick.y), hn::IfThenElse(is_thin, thin.dy, thick.dy)};
}

// Flank::push
HWY_INLINE V push_of_flank(EightGaps const& gaps, std::size_t k, V beyond, V dy) {
  return hn::Add(hn::Mul(of(gaps.square, k), beyond), hn::Mul(of(gaps.push_per_s, k), dy));
}

// LoadBehindGap::side_at
HWY_INLINE V side_at(EightGaps const& gaps, std::size_t k, Places const& at) {
  V const side = hn::CopySign(set(1.0), at.y), zero = hn::Zero(d);
  V const beyond = hn::Sub(at.y, hn::Mul(side, of(gaps.half_gap, k)));
  V const push = push_of_flank(gaps, k, beyond, at.dy);
  return hn::IfThenElseZero(hn::And(hn::Gt(hn::Mul(side, beyond), zero), hn::Gt(hn::Mul(side, push), zero)), side);
}

// loads with dry friction that have a part of this number
HWY_INLINE auto brakes(EightGaps const& gaps, EightSubSteps const& steps, double part, std::size_t k) {
  return hn::And(hn::Gt(of(gaps.is_dry, k), hn::Zero(d)), hn::Lt(set(part), of(steps.count, k)));
}

}  // namespace

void before_dry_sub_step(EightGaps const& gaps, EightSubSteps const& steps, double part, EightLoads& loads) {
  V const zero = hn::Zero(d);
  for (std::size_t k = 0; k < gap_lanes; k += hn::MaxLanes(d)) {
    V const y = of(loads.y, k), dy = of(loads.dy, k), side = of(loads.side, k), now = of(loads.now, k);
    V const beyond = hn::Sub(y, hn::Mul(side, of(gaps.half_gap, k)));
    V const of_grease = hn::Mul(of(gaps.film_push_per_s, k), dy);
    V const push = hn::Neg(hn::IfThenElse(hn::Eq(side, zero), of_grease, push_of_flank(gaps, k, beyond, dy)));
    V const per_part = hn::Div(set(1.0), of(steps.time_s, k));
    V const own =
        hn::Sub(hn::Sub(now, hn::Mul(of(loads.faster, k), per_part)), hn::Mul(of(gaps.drag_per_s, k), of(loads.dq, k)));
    V const acceleration = hn::Sub(push, own);
    V const held = hn::IfThenElse(hn::Gt(acceleration, zero), of(gaps.forward, k), of(gaps.backward, k));
    V const would = hn::IfThenElseZero(hn::Gt(hn::Abs(acceleration), held), hn::CopySign(set(1.0), acceleration));
    V const slid = of(loads.slides, k);
    auto const is_braked = brakes(gaps, steps, part, k);
    V const slides = hn::IfThenElse(hn::And(is_braked, hn::Eq(slid, zero)), would, slid);
    V const pulled = hn::IfThenElse(is_braked, hn::Add(now, dry_against(gaps, k, slides)), now);
    hn::StoreU(slides, d, loads.slides.data() + k);
    hn::StoreU(pulled, d, loads.pulled.data() + k);
    hn::StoreU(y, d, loads.y_before.data() + k);
  }
}

void after_dry_sub_step(EightGaps const& gaps, EightSubSteps const& steps, double part, EightLoads& loads) {
  V const zero = hn::Zero(d);
  for (std::size_t k = 0; k < gap_lanes; k += hn::MaxLanes(d)) {
    V const dq = of(loads.dq, k), faster = of(loads.faster, k), slides = of(loads.slides, k), dy = of(loads.dy, k);
    V const next_dq = hn::Add(dq, faster);
    auto const is_braked = brakes(gaps, steps, part, k);
    auto const rests = hn::And(is_braked, hn::Eq(slides, zero));
    V const way = hn::Mul(of(steps.time_s, k), hn::Add(dq, hn::Mul(set(0.5), faster)));
    V const y = hn::IfThenElse(rests, hn::Sub(of(loads.y_before, k), way), of(loads.y, k));
    auto const goes_on = hn::AndNot(rests, hn::Gt(hn::Mul(hn::Add(next_dq, dy), slides), zero));
    auto const is_at_rest = hn::AndNot(goes_on, is_braked);
    Places const at{y, hn::IfThenElse(is_at_rest, hn::Neg(next_dq), dy)};
    V const side = hn::IfThenElse(is_at_rest, side_at(gaps, k, at), of(loads.side, k));
    hn::StoreU(at.y, d, loads.y.data() + k);
    hn::StoreU(at.dy, d, loads.dy.data() + k);
    hn::StoreU(side, d, loads.side.data() + k);
    hn::StoreU(hn::IfThenElse(is_at_rest, zero, slides), d, loads.slides.data() + k);
    hn::StoreU(hn::IfThenElse(is_braked, next_dq, dq), d, loads.dq.data() + k);
  }
}

void speed_to(EightSubSteps const& steps, Motions const& at, bool begins, EightLoads& loads) {
  for (std::size_t k = 0; k < gap_lanes; k += hn::MaxLanes(d)) {
    V const to = of(at.dq, at.is_common, k);
    if (begins)
      hn::StoreU(hn::Div(hn::Sub(to, of(loads.dq, k)), of(steps.count, k)), d, loads.faster.data() + k);
    else
      hn::StoreU(to, d, loads.dq.data() + k);
  }
}

bool whole_sub_step(EightGaps const& gaps, EightSubSteps const& steps, double part, Eight const& driven,
                    EightLoads& loads) {
  bool any = false;
  for (std::size_t k = 0; k < gap_lanes; k += hn::MaxLanes(d)) {
    Places const at{of(loads.y, k), of(loads.dy, k)};
    V const side = of(loads.side, k), now = of(driven, k), jerk = of(loads.jerk, k);
    V const gap = hn::Mul(side, of(gaps.half_gap, k));
    auto const flies = hn::Eq(side, hn::Zero(d));
    Places next = at;
    if (!hn::AllTrue(d, flies)) {
      next = rung(gaps, steps, k, {hn::Sub(at.y, gap), at.dy}, now, jerk);
      next.y = hn::Add(next.y, gap);
    }
    if (!hn::AllFalse(d, flies)) {
      Places const in_gap = flown(gaps, steps, k, at, now, jerk);
      next = {hn::IfThenElse(flies, in_gap.y, next.y), hn::IfThenElse(flies, in_gap.dy, next.dy)};
    }
    auto const is_over = hn::Ge(set(part), of(steps.count, k));
    auto const stays = hn::Eq(side_at(gaps, k, next), side);
    auto const moves = hn::AndNot(is_over, stays);
    auto const is_quiet = hn::Or(is_over, stays);
    hn::StoreU(hn::IfThenElse(moves, next.y, at.y), d, loads.y.data() + k);
    hn::StoreU(hn::IfThenElse(moves, next.dy, at.dy), d, loads.dy.data() + k);
    hn::StoreU(hn::IfThenElse(is_quiet, hn::Zero(d), set(1.0)), d, loads.event.data() + k);
    any = any || !hn::AllTrue(d, is_quiet);
  }
  return any;
}

// Drive::after
void drive_on(EightSubSteps const& steps, EightLoads& loads) {
  for (std::size_t k = 0; k < gap_lanes; k += hn::MaxLanes(d))
    hn::StoreU(hn::Add(of(loads.now, k), hn::Mul(of(loads.jerk, k), of(steps.time_s, k))), d, loads.now.data() + k);
}

void drive_to(EightGaps const& gaps, Motions const& at, double step_s, EightLoads& loads) {
  for (std::size_t k = 0; k < gap_lanes; k += hn::MaxLanes(d)) {
    V const from = of(loads.drive, k), to = drive_of(gaps, loads, at, k);
    hn::StoreU(from, d, loads.now.data() + k);
    hn::StoreU(hn::Div(hn::Sub(to, from), set(step_s)), d, loads.jerk.data() + k);
    hn::StoreU(to, d, loads.drive.data() + k);
  }
}

void pull_of_loads(EightGaps const& gaps, EightLoads const& loads, Motions const& at, double* pull) {
  for (std::size_t k = 0; k < gap_lanes; k += hn::MaxLanes(d)) {
    V const side = of(loads.side, k), dy = of(loads.dy, k);
    V const beyond = hn::Sub(of(loads.y, k), hn::Mul(side, of(gaps.half_gap, k)));
    V const of_grease = hn::Mul(of(gaps.film_push_per_s, k), dy);
    auto const flies = hn::Eq(side, hn::Zero(d));
    V const push = hn::Neg(hn::IfThenElse(flies, of_grease, push_of_flank(gaps, k, beyond, dy)));
    V const dry = dry_against(gaps, k, of(at.dq, at.is_common, k));
    hn::StoreU(hn::Sub(push, hn::Add(drive_of(gaps, loads, at, k), dry)), d, pull + k);
  }
}

}  // namespace torquescope::load_behind_gap::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace torquescope::load_behind_gap {
namespace {
TORQUESCOPE_EXPORT(drive_to);
TORQUESCOPE_EXPORT(drive_on);
TORQUESCOPE_EXPORT(speed_to);
TORQUESCOPE_EXPORT(before_dry_sub_step);
TORQUESCOPE_EXPORT(after_dry_sub_step);
TORQUESCOPE_EXPORT(whole_sub_step);
TORQUESCOPE_EXPORT(pull_of_loads);
}  // namespace

void drive_to(EightGaps const& gaps, Motions const& at, double step_s, EightLoads& loads) {
  TORQUESCOPE_DISPATCH(drive_to)(gaps, at, step_s, loads);
}

void drive_on(EightSubSteps const& steps, EightLoads& loads) { TORQUESCOPE_DISPATCH(drive_on)(steps, loads); }

void speed_to(EightSubSteps const& steps, Motions const& at, bool begins, EightLoads& loads) {
  TORQUESCOPE_DISPATCH(speed_to)(steps, at, begins, loads);
}

void before_dry_sub_step(EightGaps const& gaps, EightSubSteps const& steps, double part, EightLoads& loads) {
  TORQUESCOPE_DISPATCH(before_dry_sub_step)(gaps, steps, part, loads);
}

void after_dry_sub_step(EightGaps const& gaps, EightSubSteps const& steps, double part, EightLoads& loads) {
  TORQUESCOPE_DISPATCH(after_dry_sub_step)(gaps, steps, part, loads);
}

bool whole_sub_step(EightGaps const& gaps, EightSubSteps const& steps, double part, Eight const& driven,
                    EightLoads& loads) {
  return TORQUESCOPE_DISPATCH(whole_sub_step)(gaps, steps, part, driven, loads);
}

void pull_of_loads(EightGaps const& gaps, EightLoads const& loads, Motions const& at, double* pull) {
  TORQUESCOPE_DISPATCH(pull_of_loads)(gaps, loads, at, pull);
}

}  // namespace torquescope::load_behind_gap
#endif  // HWY_ONCE
