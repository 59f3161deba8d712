#include "engine/effects/loads_behind_gap.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
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
using Eight = std::array<double, gap_lanes>;

// as the classes of load_behind_gap.hpp call what they have
struct EightLaws {
  Eight half_gap{};
  Eight square{}, push_per_s{}, decay{}, ringing{}, per_square{}, lag{}, per_ringing{};  // of the flank
  Eight film_push_per_s{}, per_film{};                                                   // of the grease
  Eight drag_per_s{};
  Eight forward{}, backward{}, is_dry{};  // dry friction
};

struct EightSubSteps {
  Eight count{}, time_s{}, cosine{}, sine{}, faded{}, is_thin{};
  double most = 1.0;  // of count
};

// of the motors, one each or one for all
struct Motions {
  double const *dq = nullptr, *ddq = nullptr;
  bool is_common = false;
};

struct EightLoads {
  Eight y{}, dy{}, side{};
  Eight weight{}, drive{};  // where the joint is
  Eight now{}, jerk{};      // what drives them in a step
  Eight event{};            // 1 where contact begins or ends, and nothing was changed
  // of those with dry friction: the joint's speed and what it gains in a part, the load's own direction, what drives it, friction
  // included, and where it was before the part
  Eight dq{}, faster{}, slides{}, pulled{}, y_before{};
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
HWY_INLINE V of(Eight const& values, std::size_t lane) { return hn::LoadU(d, values.data() + lane); }

HWY_INLINE V of(double const* values, bool is_common, std::size_t lane) {
  return is_common ? set(*values) : hn::LoadU(d, values + lane);
}

// LoadBehindGap::drive_of
HWY_INLINE V drive_of(EightLaws const& laws, EightLoads const& loads, Motions const& at, std::size_t k) {
  V const pulled = hn::Add(of(at.ddq, at.is_common, k), of(loads.weight, k));
  return hn::Add(pulled, hn::Mul(of(laws.drag_per_s, k), of(at.dq, at.is_common, k)));
}

// DryFriction::against
HWY_INLINE V dry_against(EightLaws const& laws, std::size_t k, V slides) {
  V const zero = hn::Zero(d);
  V const backward = hn::IfThenElseZero(hn::Lt(slides, zero), hn::Neg(of(laws.backward, k)));
  return hn::IfThenElse(hn::Gt(slides, zero), of(laws.forward, k), backward);
}

struct Places {
  V y, dy;
};

// Flank::ring over a whole sub-step; the place relative to where the flank begins
HWY_INLINE Places rung(EightLaws const& laws, EightSubSteps const& steps, std::size_t k, Places const& from, V now,
                       V jerk) {
  V const per_square = of(laws.per_square, k), decay = of(laws.decay, k), ringing = of(laws.ringing, k);
  V const cosine = of(steps.cosine, k), sine = of(steps.sine, k);
  V const follow = hn::Add(hn::Mul(hn::Neg(now), per_square), hn::Mul(of(laws.lag, k), jerk));
  V const dfollow = hn::Mul(hn::Neg(jerk), per_square);
  V const free = hn::Sub(from.y, follow), dfree = hn::Sub(from.dy, dfollow);
  V const quadrature = hn::Mul(hn::Add(dfree, hn::Mul(decay, free)), of(laws.per_ringing, k));
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

HWY_INLINE Places flown(EightLaws const& laws, EightSubSteps const& steps, std::size_t k, Places const& from, V now,
                        V jerk) {
  V const time_s = of(steps.time_s, k);
  auto const is_thin = hn::Gt(of(steps.is_thin, k), hn::Zero(d));
  if (hn::AllTrue(d, is_thin)) return flown_thinly(time_s, from, now, jerk);
  Places const thick = flown_thickly(time_s, of(laws.per_film, k), of(steps.faded, k), from, now, jerk);
  if (hn::AllFalse(d, is_thin)) return thick;
  Places const thin = flown_thinly(time_s, from, now, jerk);
  return {hn::IfThenElse(is_thin, thin.y, thick.y), hn::IfThenElse(is_thin, thin.dy, thick.dy)};
}

// Flank::push
HWY_INLINE V push_of_flank(EightLaws const& laws, std::size_t k, V beyond, V dy) {
  return hn::Add(hn::Mul(of(laws.square, k), beyond), hn::Mul(of(laws.push_per_s, k), dy));
}

// LoadBehindGap::side_at
HWY_INLINE V side_at(EightLaws const& laws, std::size_t k, Places const& at) {
  V const side = hn::CopySign(set(1.0), at.y), zero = hn::Zero(d);
  V const beyond = hn::Sub(at.y, hn::Mul(side, of(laws.half_gap, k)));
  V const push = push_of_flank(laws, k, beyond, at.dy);
  return hn::IfThenElseZero(hn::And(hn::Gt(hn::Mul(side, beyond), zero), hn::Gt(hn::Mul(side, push), zero)), side);
}

// loads with dry friction that have a part of this number
HWY_INLINE auto brakes(EightLaws const& laws, EightSubSteps const& steps, double part, std::size_t k) {
  return hn::And(hn::Gt(of(laws.is_dry, k), hn::Zero(d)), hn::Lt(set(part), of(steps.count, k)));
}

}  // namespace

// LoadBehindGap::dry_sub_step up to the sub-step itself
void before_dry_sub_step(EightLaws const& laws, EightSubSteps const& steps, double part, EightLoads& loads) {
  V const zero = hn::Zero(d);
  for (std::size_t k = 0; k < gap_lanes; k += hn::MaxLanes(d)) {
    V const y = of(loads.y, k), dy = of(loads.dy, k), side = of(loads.side, k), now = of(loads.now, k);
    V const beyond = hn::Sub(y, hn::Mul(side, of(laws.half_gap, k)));
    V const of_grease = hn::Mul(of(laws.film_push_per_s, k), dy);
    V const push = hn::Neg(hn::IfThenElse(hn::Eq(side, zero), of_grease, push_of_flank(laws, k, beyond, dy)));
    V const per_part = hn::Div(set(1.0), of(steps.time_s, k));
    V const own =
        hn::Sub(hn::Sub(now, hn::Mul(of(loads.faster, k), per_part)), hn::Mul(of(laws.drag_per_s, k), of(loads.dq, k)));
    V const acceleration = hn::Sub(push, own);
    V const held = hn::IfThenElse(hn::Gt(acceleration, zero), of(laws.forward, k), of(laws.backward, k));
    V const would = hn::IfThenElseZero(hn::Gt(hn::Abs(acceleration), held), hn::CopySign(set(1.0), acceleration));
    V const slid = of(loads.slides, k);
    auto const is_braked = brakes(laws, steps, part, k);
    V const slides = hn::IfThenElse(hn::And(is_braked, hn::Eq(slid, zero)), would, slid);
    V const pulled = hn::IfThenElse(is_braked, hn::Add(now, dry_against(laws, k, slides)), now);
    hn::StoreU(slides, d, loads.slides.data() + k);
    hn::StoreU(pulled, d, loads.pulled.data() + k);
    hn::StoreU(y, d, loads.y_before.data() + k);
  }
}

// and after it
void after_dry_sub_step(EightLaws const& laws, EightSubSteps const& steps, double part, EightLoads& loads) {
  V const zero = hn::Zero(d);
  for (std::size_t k = 0; k < gap_lanes; k += hn::MaxLanes(d)) {
    V const dq = of(loads.dq, k), faster = of(loads.faster, k), slides = of(loads.slides, k), dy = of(loads.dy, k);
    V const next_dq = hn::Add(dq, faster);
    auto const is_braked = brakes(laws, steps, part, k);
    auto const rests = hn::And(is_braked, hn::Eq(slides, zero));
    V const way = hn::Mul(of(steps.time_s, k), hn::Add(dq, hn::Mul(set(0.5), faster)));
    V const y = hn::IfThenElse(rests, hn::Sub(of(loads.y_before, k), way), of(loads.y, k));
    auto const goes_on = hn::AndNot(rests, hn::Gt(hn::Mul(hn::Add(next_dq, dy), slides), zero));
    auto const is_at_rest = hn::AndNot(goes_on, is_braked);
    Places const at{y, hn::IfThenElse(is_at_rest, hn::Neg(next_dq), dy)};
    V const side = hn::IfThenElse(is_at_rest, side_at(laws, k, at), of(loads.side, k));
    hn::StoreU(at.y, d, loads.y.data() + k);
    hn::StoreU(at.dy, d, loads.dy.data() + k);
    hn::StoreU(side, d, loads.side.data() + k);
    hn::StoreU(hn::IfThenElse(is_at_rest, zero, slides), d, loads.slides.data() + k);
    hn::StoreU(hn::IfThenElse(is_braked, next_dq, dq), d, loads.dq.data() + k);
  }
}

// the speed of the joint at the end of a step, for loads with dry friction: what is gained on the way, and that it is there
void speed_to(EightSubSteps const& steps, Motions const& at, bool begins, EightLoads& loads) {
  for (std::size_t k = 0; k < gap_lanes; k += hn::MaxLanes(d)) {
    V const to = of(at.dq, at.is_common, k);
    if (begins)
      hn::StoreU(hn::Div(hn::Sub(to, of(loads.dq, k)), of(steps.count, k)), d, loads.faster.data() + k);
    else
      hn::StoreU(to, d, loads.dq.data() + k);
  }
}

// the part of this number, of loads that have so many; whether there was any event. driven: as loads.now, or friction included
bool whole_sub_step(EightLaws const& laws, EightSubSteps const& steps, double part, Eight const& driven,
                    EightLoads& loads) {
  bool any = false;
  for (std::size_t k = 0; k < gap_lanes; k += hn::MaxLanes(d)) {
    Places const at{of(loads.y, k), of(loads.dy, k)};
    V const side = of(loads.side, k), now = of(driven, k), jerk = of(loads.jerk, k);
    V const gap = hn::Mul(side, of(laws.half_gap, k));
    auto const flies = hn::Eq(side, hn::Zero(d));
    Places next = at;
    if (!hn::AllTrue(d, flies)) {
      next = rung(laws, steps, k, {hn::Sub(at.y, gap), at.dy}, now, jerk);
      next.y = hn::Add(next.y, gap);
    }
    if (!hn::AllFalse(d, flies)) {
      Places const in_gap = flown(laws, steps, k, at, now, jerk);
      next = {hn::IfThenElse(flies, in_gap.y, next.y), hn::IfThenElse(flies, in_gap.dy, next.dy)};
    }
    auto const is_over = hn::Ge(set(part), of(steps.count, k));
    auto const stays = hn::Eq(side_at(laws, k, next), side);
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

// the joint comes to `at` within a step
void drive_to(EightLaws const& laws, Motions const& at, double step_s, EightLoads& loads) {
  for (std::size_t k = 0; k < gap_lanes; k += hn::MaxLanes(d)) {
    V const from = of(loads.drive, k), to = drive_of(laws, loads, at, k);
    hn::StoreU(from, d, loads.now.data() + k);
    hn::StoreU(hn::Div(hn::Sub(to, from), set(step_s)), d, loads.jerk.data() + k);
    hn::StoreU(to, d, loads.drive.data() + k);
  }
}

// LoadBehindGap::push less what a load that is fixed to the motor would need there
void pull_of_loads(EightLaws const& laws, EightLoads const& loads, Motions const& at, double* pull) {
  for (std::size_t k = 0; k < gap_lanes; k += hn::MaxLanes(d)) {
    V const side = of(loads.side, k), dy = of(loads.dy, k);
    V const beyond = hn::Sub(of(loads.y, k), hn::Mul(side, of(laws.half_gap, k)));
    V const of_grease = hn::Mul(of(laws.film_push_per_s, k), dy);
    auto const flies = hn::Eq(side, hn::Zero(d));
    V const push = hn::Neg(hn::IfThenElse(flies, of_grease, push_of_flank(laws, k, beyond, dy)));
    V const dry = dry_against(laws, k, of(at.dq, at.is_common, k));
    hn::StoreU(hn::Sub(push, hn::Add(drive_of(laws, loads, at, k), dry)), d, pull + k);
  }
}

// of eight loads of this size
void put_torques(double const* pull, double size, double* torque) {
  for (std::size_t lane = 0; lane < gap_lanes; lane += hn::MaxLanes(d))
    hn::StoreU(hn::Add(hn::Zero(d), hn::Mul(set(size), hn::LoadU(d, pull + lane))), d, torque + lane);
}

}  // namespace torquescope::load_behind_gap::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace torquescope::load_behind_gap {
namespace {

TORQUESCOPE_EXPORT(before_dry_sub_step);
TORQUESCOPE_EXPORT(after_dry_sub_step);
TORQUESCOPE_EXPORT(speed_to);
TORQUESCOPE_EXPORT(whole_sub_step);
TORQUESCOPE_EXPORT(drive_on);
TORQUESCOPE_EXPORT(drive_to);
TORQUESCOPE_EXPORT(pull_of_loads);
TORQUESCOPE_EXPORT(put_torques);

class LoadsBehindGap final : public EffectMemory {
 public:
  LoadsBehindGap(LoadBehindGap const& fresh, std::size_t lanes) {
    for (std::size_t lane = 0; lane < lanes; ++lane) add(fresh);
  }

  void append(EffectMemory const& other) override {
    for (LoadBehindGap const& fresh : static_cast<LoadsBehindGap const&>(other).loads_) add(fresh);
  }

  void columns(EffectInput const& input, Eigen::Ref<Eigen::MatrixXd> out) override {
    std::vector<double> const weights = weights_on(input.motion.q);
    Eight pull{};
    for (Eigen::Index i = 0; i < input.size(); ++i) {
      Motions const at{&input.motion.dq[i], &input.motion.ddq[i], true};
      for (std::size_t block = 0; block < blocks_.size(); ++block) {
        auto& [laws, loads, has_dry] = blocks_[block];
        if (i > 0) {
          if (!weights.empty()) loads.weight.fill(weights[static_cast<std::size_t>(i)]);
          follow(block, at, input.motion.time_s[i] - input.motion.time_s[i - 1]);
        } else {
          start(block, [&](std::size_t) { return input.state(0); });
        }
        TORQUESCOPE_DISPATCH(pull_of_loads)(laws, loads, at, pull.data());
        for (std::size_t k = 0; k < lanes_of(block); ++k)
          out(i, static_cast<Eigen::Index>(block * gap_lanes + k)) = pull[k];
      }
    }
  }

  void advance(JointStates const& at, double step_s) override {
    bool const has_started = std::exchange(has_started_, true);
    for (std::size_t block = 0; block < blocks_.size(); ++block) {
      if (has_started) {
        Room room;
        weigh(block, at);
        follow(block, motions(at, block, room), step_s);
      } else {
        start(block, [&](std::size_t lane) { return at.state(lane); });
      }
    }
  }

  void torques(JointStates const& at, std::span<double const> linear, std::span<double> out) const override {
    TORQUESCOPE_EXPECT(linear.size() == 1 && out.size() == loads_.size());
    for (std::size_t block = 0; block < blocks_.size(); ++block) {
      Room room;
      Eight pull;
      auto const& [laws, loads, has_dry] = blocks_[block];
      TORQUESCOPE_DISPATCH(pull_of_loads)(laws, loads, motions(at, block, room), pull.data());
      TORQUESCOPE_DISPATCH(put_torques)(pull.data(), linear[0], pull.data());
      std::copy_n(pull.begin(), lanes_of(block), out.begin() + static_cast<std::ptrdiff_t>(block * gap_lanes));
    }
  }

 private:
  // lanes behind the last load are never in a gap and never meet a flank
  struct Block {
    EightLaws laws{};
    EightLoads loads{};
    bool has_dry = false;
  };
  // for motions of a block that is not full
  struct Room {
    Eight dq, ddq;
  };

  void add(LoadBehindGap const& fresh) {
    std::size_t const k = loads_.size() % gap_lanes;
    loads_.push_back(fresh);
    if (k == 0) blocks_.emplace_back();
    EightLaws& laws = blocks_.back().laws;
    Flank const& flank = fresh.flank();
    laws.half_gap[k] = fresh.half_gap();
    laws.square[k] = flank.omega() * flank.omega();
    laws.push_per_s[k] = flank.push_per_s();
    laws.decay[k] = flank.decay();
    laws.ringing[k] = flank.ringing();
    laws.per_square[k] = flank.per_square();
    laws.lag[k] = flank.lag();
    laws.per_ringing[k] = flank.per_ringing();
    laws.film_push_per_s[k] = fresh.grease().push_per_s();
    laws.per_film[k] = fresh.grease().per_film();
    laws.drag_per_s[k] = fresh.drag_per_s();
    laws.forward[k] = fresh.dry().forward;
    laws.backward[k] = fresh.dry().backward;
    laws.is_dry[k] = fresh.dry().is_there() ? 1.0 : 0.0;
    blocks_.back().has_dry = blocks_.back().has_dry || fresh.dry().is_there();
  }

  std::size_t lanes_of(std::size_t block) const { return std::min(gap_lanes, loads_.size() - block * gap_lanes); }

  Motions motions(JointStates const& at, std::size_t block, Room& room) const {
    std::size_t const first = block * gap_lanes, lanes = lanes_of(block);
    if (lanes == gap_lanes) return {at.dq.data() + first, at.ddq.data() + first};
    room.dq.fill(0.0);
    room.ddq.fill(0.0);
    std::copy_n(at.dq.data() + first, lanes, room.dq.begin());
    std::copy_n(at.ddq.data() + first, lanes, room.ddq.begin());
    return {room.dq.data(), room.ddq.data()};
  }

  // what all loads of one motion weigh; empty: nothing
  std::vector<double> weights_on(Eigen::VectorXd const& q) const {
    LoadBehindGap const& any = loads_.front();
    if (!any.has_weight()) return {};
    auto const n = static_cast<std::size_t>(q.size());
    std::vector<double> weights(n), cosine(n), sine(n);
    kernels::cosine_sine_of_multiple(1.0, q.data(), n, cosine.data(), sine.data());
    for (std::size_t i = 0; i < n; ++i) weights[i] = any.weight(cosine[i], sine[i]);
    return weights;
  }

  void weigh(std::size_t block, JointStates const& at) {
    LoadBehindGap const& any = loads_.front();
    if (!any.has_weight()) return;
    Eight cosine, sine;
    std::size_t const lanes = lanes_of(block);
    kernels::cosine_sine_of_multiple(1.0, at.q.data() + block * gap_lanes, lanes, cosine.data(), sine.data());
    for (std::size_t k = 0; k < lanes; ++k) blocks_[block].loads.weight[k] = any.weight(cosine[k], sine[k]);
  }

  template <typename StateOf>
  void start(std::size_t block, StateOf const& state_of) {
    for (std::size_t k = 0; k < lanes_of(block); ++k) {
      LoadBehindGap& load = loads_[block * gap_lanes + k];
      load.start(state_of(block * gap_lanes + k));
      take(block, k);
      blocks_[block].loads.weight[k] = load.load().weight;
      blocks_[block].loads.drive[k] = load.load().drive;
      blocks_[block].loads.dq[k] = load.load().dq;
      blocks_[block].loads.slides[k] = load.load().slides;
    }
  }

  // weights are known
  void follow(std::size_t block, Motions const& at, double step_s) {
    auto& [laws, loads, has_dry] = blocks_[block];
    EightSubSteps const& steps = sub_steps_in(step_s)[block];
    TORQUESCOPE_DISPATCH(drive_to)(laws, at, step_s, loads);
    if (has_dry) TORQUESCOPE_DISPATCH(speed_to)(steps, at, true, loads);
    Eight const& driven = has_dry ? loads.pulled : loads.now;
    for (double part = 0.0; part < steps.most; part += 1.0) {
      if (has_dry) TORQUESCOPE_DISPATCH(before_dry_sub_step)(laws, steps, part, loads);
      if (TORQUESCOPE_DISPATCH(whole_sub_step)(laws, steps, part, driven, loads)) meet_events(block, driven, step_s);
      if (has_dry) TORQUESCOPE_DISPATCH(after_dry_sub_step)(laws, steps, part, loads);
      TORQUESCOPE_DISPATCH(drive_on)(steps, loads);
    }
    if (has_dry) TORQUESCOPE_DISPATCH(speed_to)(steps, at, false, loads);
  }

  std::vector<EightSubSteps> const& sub_steps_in(double step_s) {
    return remembered_.of(step_s, [this](double whole_s) {
      std::vector<EightSubSteps> steps(blocks_.size());
      for (auto& one : steps) one.is_thin.fill(1.0);
      for (std::size_t lane = 0; lane < loads_.size(); ++lane) {
        loads_[lane].divide(whole_s);
        GapSubSteps const& own = loads_[lane].sub_steps();
        EightSubSteps& all = steps[lane / gap_lanes];
        std::size_t const k = lane % gap_lanes;
        all.count[k] = own.count;
        all.time_s[k] = own.time_s;
        all.cosine[k] = own.fading.cosine;
        all.sine[k] = own.fading.sine;
        all.faded[k] = own.faded;
        all.is_thin[k] = loads_[lane].grease().is_thin(own.time_s) ? 1.0 : 0.0;
        all.most = std::max(all.most, all.count[k]);
      }
      return steps;
    });
  }

  // one load after the other: few at a time meet a flank
  void meet_events(std::size_t block, Eight const& driven, double step_s) {
    EightLoads const& loads = blocks_[block].loads;
    for (std::size_t k = 0; k < lanes_of(block); ++k) {
      if (loads.event[k] == 0.0) continue;
      LoadBehindGap& load = loads_[block * gap_lanes + k];
      load.divide(step_s);
      load.put({{loads.y[k], loads.dy[k]}, loads.side[k], loads.weight[k], loads.drive[k]});
      load.sub_step({driven[k], loads.jerk[k]});
      take(block, k);
    }
  }

  void take(std::size_t block, std::size_t k) {
    LoadState const& load = loads_[block * gap_lanes + k].load();
    EightLoads& loads = blocks_[block].loads;
    loads.y[k] = load.at.y;
    loads.dy[k] = load.at.dy;
    loads.side[k] = load.side;
  }

  std::vector<LoadBehindGap> loads_{};  // one per lane: its law, and what one event needs
  std::vector<Block> blocks_{};
  RememberedSteps<std::vector<EightSubSteps>> remembered_{};
  bool has_started_ = false;
};

}  // namespace

std::unique_ptr<EffectMemory> loads_behind_gap(LoadBehindGap const& fresh, std::size_t lanes) {
  return std::make_unique<LoadsBehindGap>(fresh, lanes);
}

}  // namespace torquescope::load_behind_gap
#endif  // HWY_ONCE
