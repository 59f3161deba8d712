#include "engine/effects/loads_behind_gap.hpp"

#include <algorithm>
#include <array>
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
using Eight = std::array<double, gap_lanes>;

// as the classes of load_behind_gap.hpp call what they have
struct EightLaws {
  Eight half_gap{};
  Eight square{}, push_per_s{}, decay{}, ringing{}, per_square{}, lag{}, per_ringing{};  // of the flank
  Eight film_push_per_s{}, per_film{};                                                   // of the grease
};

struct EightSubSteps {
  Eight count{}, time_s{}, cosine{}, sine{}, faded{}, is_thin{};
  double most = 1.0;  // of count
};

struct EightLoads {
  Eight y{}, dy{}, side{};
  Eight now{}, jerk{};  // what drives them
  Eight event{};        // 1 where contact begins or ends, and nothing was changed
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

}  // namespace

// the part of this number, of loads that have so many; whether there was any event
bool whole_sub_step(EightLaws const& laws, EightSubSteps const& steps, double part, EightLoads& loads) {
  bool any = false;
  for (std::size_t k = 0; k < gap_lanes; k += hn::MaxLanes(d)) {
    Places const at{of(loads.y, k), of(loads.dy, k)};
    V const side = of(loads.side, k), now = of(loads.now, k), jerk = of(loads.jerk, k);
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

// LoadBehindGap::push
void push_of_loads(EightLaws const& laws, EightLoads const& loads, double* push) {
  for (std::size_t k = 0; k < gap_lanes; k += hn::MaxLanes(d)) {
    V const side = of(loads.side, k), dy = of(loads.dy, k);
    V const beyond = hn::Sub(of(loads.y, k), hn::Mul(side, of(laws.half_gap, k)));
    V const of_grease = hn::Mul(of(laws.film_push_per_s, k), dy);
    auto const flies = hn::Eq(side, hn::Zero(d));
    hn::StoreU(hn::Neg(hn::IfThenElse(flies, of_grease, push_of_flank(laws, k, beyond, dy))), d, push + k);
  }
}

}  // namespace torquescope::load_behind_gap::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace torquescope::load_behind_gap {
namespace {

TORQUESCOPE_EXPORT(whole_sub_step);
TORQUESCOPE_EXPORT(drive_on);
TORQUESCOPE_EXPORT(push_of_loads);

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
    Eight push{};
    for (Eigen::Index i = 0; i < input.size(); ++i) {
      JointState const now = input.state(i);
      std::fill(weight_.begin(), weight_.end(), weights[static_cast<std::size_t>(i)]);
      if (i == 0)
        for (std::size_t lane = 0; lane < loads_.size(); ++lane) start(lane, now);
      else
        follow([&](std::size_t) { return now; }, input.motion.time_s[i] - input.motion.time_s[i - 1]);
      for (std::size_t block = 0; block < blocks_.size(); ++block) {
        TORQUESCOPE_DISPATCH(push_of_loads)(blocks_[block].laws, blocks_[block].loads, push.data());
        for (std::size_t k = 0; k < lanes_of(block); ++k) {
          std::size_t const lane = block * gap_lanes + k;
          out(i, static_cast<Eigen::Index>(lane)) = push[k] - drive_[lane];
        }
      }
    }
  }

  void advance(JointStates const& at, double step_s) override {
    if (!has_started_) {
      has_started_ = true;
      for (std::size_t lane = 0; lane < loads_.size(); ++lane) start(lane, at.state(lane));
      return;
    }
    if (loads_.front().has_weight()) {
      kernels::cosine_sine_of_multiple(1.0, at.q.data(), loads_.size(), cosine_.data(), sine_.data());
      for (std::size_t lane = 0; lane < loads_.size(); ++lane)
        weight_[lane] = loads_.front().weight(cosine_[lane], sine_[lane]);
    }
    follow([&](std::size_t lane) { return at.state(lane); }, step_s);
  }

  void torques(JointStates const& at, std::span<double const> linear, std::span<double> out) const override {
    TORQUESCOPE_EXPECT(linear.size() == 1 && out.size() == loads_.size());
    Eight push{};
    for (std::size_t block = 0; block < blocks_.size(); ++block) {
      TORQUESCOPE_DISPATCH(push_of_loads)(blocks_[block].laws, blocks_[block].loads, push.data());
      for (std::size_t k = 0; k < lanes_of(block); ++k) {
        std::size_t const lane = block * gap_lanes + k;
        out[lane] = 0.0 + linear[0] * (push[k] - loads_[lane].drive_of(at.state(lane), weight_[lane]));
      }
    }
  }

 private:
  // lanes behind the last load are never in a gap and never meet a flank
  struct Block {
    EightLaws laws{};
    EightLoads loads{};
  };

  void add(LoadBehindGap const& fresh) {
    std::size_t const k = loads_.size() % gap_lanes;
    loads_.push_back(fresh);
    for (auto* one : {&weight_, &cosine_, &sine_, &drive_}) one->push_back(0.0);
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
  }

  std::size_t lanes_of(std::size_t block) const { return std::min(gap_lanes, loads_.size() - block * gap_lanes); }

  // what all loads of one motion weigh
  std::vector<double> weights_on(Eigen::VectorXd const& q) const {
    LoadBehindGap const& any = loads_.front();
    auto const n = static_cast<std::size_t>(q.size());
    std::vector<double> weights(n, 0.0);
    if (!any.has_weight()) return weights;
    std::vector<double> cosine(n), sine(n);
    kernels::cosine_sine_of_multiple(1.0, q.data(), n, cosine.data(), sine.data());
    for (std::size_t i = 0; i < n; ++i) weights[i] = any.weight(cosine[i], sine[i]);
    return weights;
  }

  void start(std::size_t lane, JointState const& state) {
    loads_[lane].start(state);
    take(lane);
    weight_[lane] = loads_[lane].load().weight;
    drive_[lane] = loads_[lane].load().drive;
  }

  // weights are known; state_of(lane)
  template <typename StateOf>
  void follow(StateOf const& state_of, double step_s) {
    auto const& steps = sub_steps_in(step_s);
    for (std::size_t lane = 0; lane < loads_.size(); ++lane) {
      EightLoads& loads = blocks_[lane / gap_lanes].loads;
      double const end = loads_[lane].drive_of(state_of(lane), weight_[lane]);
      loads.now[lane % gap_lanes] = drive_[lane];
      loads.jerk[lane % gap_lanes] = (end - drive_[lane]) / step_s;
      drive_[lane] = end;
    }
    auto const sub_step = TORQUESCOPE_DISPATCH(whole_sub_step);
    auto const drive = TORQUESCOPE_DISPATCH(drive_on);
    for (std::size_t block = 0; block < blocks_.size(); ++block) {
      auto& [laws, loads] = blocks_[block];
      for (double part = 0.0; part < steps[block].most; part += 1.0) {
        if (sub_step(laws, steps[block], part, loads)) meet_events(block, step_s);
        drive(steps[block], loads);
      }
    }
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
  void meet_events(std::size_t block, double step_s) {
    EightLoads const& loads = blocks_[block].loads;
    for (std::size_t k = 0; k < lanes_of(block); ++k) {
      if (loads.event[k] == 0.0) continue;
      std::size_t const lane = block * gap_lanes + k;
      loads_[lane].divide(step_s);
      loads_[lane].put({{loads.y[k], loads.dy[k]}, loads.side[k], weight_[lane], drive_[lane]});
      loads_[lane].sub_step({loads.now[k], loads.jerk[k]});
      take(lane);
    }
  }

  void take(std::size_t lane) {
    LoadState const& load = loads_[lane].load();
    EightLoads& loads = blocks_[lane / gap_lanes].loads;
    std::size_t const k = lane % gap_lanes;
    loads.y[k] = load.at.y;
    loads.dy[k] = load.at.dy;
    loads.side[k] = load.side;
  }

  std::vector<LoadBehindGap> loads_{};  // one per lane: its law, and what one event needs
  std::vector<double> weight_{}, cosine_{}, sine_{}, drive_{};
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
