#include "engine/effects/loads_on_spring.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "engine/effects/remembered_steps.hpp"
#include "kernels/dispatch-inl.hpp"

// the part up to HWY_ONCE is compiled once per instruction set
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/effects/loads_on_spring.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#ifndef TORQUESCOPE_EFFECTS_LOADS_ON_SPRING
#define TORQUESCOPE_EFFECTS_LOADS_ON_SPRING
namespace torquescope::load_on_spring {

inline constexpr std::size_t spring_lanes = 8;
inline constexpr double most_stiffening = 25.0;  // times as stiff as unloaded: no gear goes further
using Eight = std::array<double, spring_lanes>;

struct EightLoads {
  Eight square{}, decay{}, ringing{};  // of w = 2 pi f: w^2, zeta w, and with what it rings
  Eight per_square{};                  // stiffening per y^2
  Eight y{}, dy{}, ddq{};              // relative to the motor; the motor's acceleration
};

// of the motors. Not copied into an array of eight: a vector loaded from what single numbers were just stored into
// waits for them
struct Accelerations {
  double const* first = nullptr;
  bool is_common = false;
};

// straight springs in one part of a step
struct EightSwings {
  Eight parts{}, step_s{}, faded{}, cosine{}, sine{};
  double most_parts = 1.0;
};

}  // namespace torquescope::load_on_spring
#endif

HWY_BEFORE_NAMESPACE();
namespace torquescope::load_on_spring::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

namespace {

using D = hn::CappedTag<double, spring_lanes>;
using V = hn::Vec<D>;
inline constexpr D d;

HWY_INLINE V of(Eight const& values, std::size_t lane) { return hn::LoadU(d, values.data() + lane); }
HWY_INLINE V set(double value) { return hn::Set(d, value); }
// one for all lanes, or one each
HWY_INLINE V of(Accelerations const& ddq, std::size_t lane) {
  return ddq.is_common ? set(*ddq.first) : hn::LoadU(d, ddq.first + lane);
}

// acceleration of the load by what the spring has more than a straight one
HWY_INLINE V stiffened(V square, V per_square, V y) {
  V const share = hn::Mul(hn::Mul(per_square, y), y), most = set(most_stiffening);
  return hn::Mul(hn::Mul(square, y), hn::IfThenElse(hn::Lt(most, share), most, share));
}

}  // namespace

void advance_loads(EightLoads& loads, EightSwings const& swings, Accelerations const& ddq, double step_s) {
  for (std::size_t lane = 0; lane < spring_lanes; lane += hn::MaxLanes(d)) {
    V const square = of(loads.square, lane), decay = of(loads.decay, lane), ringing = of(loads.ringing, lane);
    V const per_square = of(loads.per_square, lane), part_s = of(swings.step_s, lane), parts = of(swings.parts, lane);
    V const faded = of(swings.faded, lane), cosine = of(swings.cosine, lane), sine = of(swings.sine, lane);
    V const half_s = hn::Mul(set(0.5), part_s), end = of(ddq, lane);
    V y = of(loads.y, lane), dy = of(loads.dy, lane), now = of(loads.ddq, lane);
    V const jerk = hn::Div(hn::Sub(end, now), set(step_s));
    // what remains after the motion that follows a straight acceleration rings freely
    V const lag = hn::Div(hn::Mul(hn::Mul(set(2.0), decay), jerk), hn::Mul(square, square));
    V const dfollow = hn::Div(hn::Neg(jerk), square);
    for (double part = 0.0; part < swings.most_parts; part += 1.0) {
      V const kicked = hn::Sub(dy, hn::Mul(half_s, stiffened(square, per_square, y)));
      V const follow = hn::Add(hn::Div(hn::Neg(now), square), lag);
      V const free = hn::Sub(y, follow), dfree = hn::Sub(kicked, dfollow);
      V const quadrature = hn::Div(hn::Add(dfree, hn::Mul(decay, free)), ringing);
      V const rung = hn::Mul(faded, hn::Add(hn::Mul(free, cosine), hn::Mul(quadrature, sine)));
      V const in_phase = hn::Mul(hn::Sub(hn::Mul(quadrature, ringing), hn::Mul(decay, free)), cosine);
      V const across = hn::Mul(hn::Add(hn::Mul(free, ringing), hn::Mul(decay, quadrature)), sine);
      V const drung = hn::Mul(faded, hn::Sub(in_phase, across));
      V const next = hn::Add(hn::Add(rung, follow), hn::Mul(dfollow, part_s));
      V const coasted = hn::Add(drung, dfollow);
      V const dnext = hn::Sub(coasted, hn::Mul(half_s, stiffened(square, per_square, next)));
      // stiffer springs take more parts
      auto const goes = hn::Lt(set(part), parts);
      y = hn::IfThenElse(goes, next, y);
      dy = hn::IfThenElse(goes, dnext, dy);
      now = hn::IfThenElse(goes, hn::Add(now, hn::Mul(jerk, part_s)), now);
    }
    hn::StoreU(y, d, loads.y.data() + lane);
    hn::StoreU(dy, d, loads.dy.data() + lane);
    hn::StoreU(end, d, loads.ddq.data() + lane);
  }
}

// of a load of one unit on the motor that has come to this acceleration, beside what a rigid one would need
void pull_of_loads(EightLoads const& loads, Accelerations const& ddq, double* pull) {
  for (std::size_t lane = 0; lane < spring_lanes; lane += hn::MaxLanes(d)) {
    V const square = of(loads.square, lane), y = of(loads.y, lane);
    V const damped = hn::Mul(hn::Mul(set(2.0), of(loads.decay, lane)), of(loads.dy, lane));
    V const straight = hn::Add(damped, hn::Mul(square, y));
    V const pushed = hn::Add(straight, stiffened(square, of(loads.per_square, lane), y));
    hn::StoreU(hn::Sub(hn::Neg(pushed), of(ddq, lane)), d, pull + lane);
  }
}

}  // namespace torquescope::load_on_spring::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace torquescope::load_on_spring {
namespace {

TORQUESCOPE_EXPORT(advance_loads);
TORQUESCOPE_EXPORT(pull_of_loads);

class LoadsOnSpring final : public EffectMemory {
 public:
  LoadsOnSpring(Spring const& spring, std::size_t lanes) {
    for (std::size_t lane = 0; lane < lanes; ++lane) add(spring);
  }

  void append(EffectMemory const& other) override {
    for (Spring const& spring : static_cast<LoadsOnSpring const&>(other).springs_) add(spring);
  }

  void columns(EffectInput const& input, Eigen::Ref<Eigen::MatrixXd> out) override {
    Eight pull{};
    for (Eigen::Index i = 0; i < input.size(); ++i) {
      Accelerations const ddq{&input.motion.ddq[i], true};
      double const step_s = i == 0 ? 0.0 : input.motion.time_s[i] - input.motion.time_s[i - 1];
      auto const* swings = i == 0 ? nullptr : &swings_in(step_s);
      for (std::size_t block = 0; block < blocks_.size(); ++block) {
        if (swings == nullptr)
          start(blocks_[block], ddq);
        else
          TORQUESCOPE_DISPATCH(advance_loads)(blocks_[block], (*swings)[block], ddq, step_s);
        TORQUESCOPE_DISPATCH(pull_of_loads)(blocks_[block], ddq, pull.data());
        for (std::size_t k = 0; k < lanes_of(block); ++k)
          out(i, static_cast<Eigen::Index>(block * spring_lanes + k)) = pull[k];
      }
    }
  }

  void advance(JointStates const& at, double step_s) override {
    auto const* swings = has_started_ ? &swings_in(step_s) : nullptr;
    for (std::size_t block = 0; block < blocks_.size(); ++block) {
      Eight room;
      Accelerations const ddq = accelerations(at, block, room);
      if (swings == nullptr)
        start(blocks_[block], ddq);
      else
        TORQUESCOPE_DISPATCH(advance_loads)(blocks_[block], (*swings)[block], ddq, step_s);
    }
    has_started_ = true;
  }

  void torques(JointStates const& at, ParametersOfEach const& linear, std::span<double> out) const override {
    TORQUESCOPE_EXPECT(linear.cols() == 1 && out.size() == springs_.size());
    TORQUESCOPE_EXPECT(linear.rows() == static_cast<Eigen::Index>(out.size()));
    for (std::size_t block = 0; block < blocks_.size(); ++block) {
      Eight room, pull;
      TORQUESCOPE_DISPATCH(pull_of_loads)(blocks_[block], accelerations(at, block, room), pull.data());
      for (std::size_t k = 0; k < lanes_of(block); ++k) {
        std::size_t const lane = block * spring_lanes + k;
        out[lane] = 0.0 + linear(static_cast<Eigen::Index>(lane), 0) * pull[k];
      }
    }
  }

 private:
  // lanes behind the last repeat it
  void add(Spring const& spring) {
    std::size_t const lane = springs_.size() % spring_lanes;
    springs_.push_back(spring);
    if (lane == 0) blocks_.emplace_back();
    EightLoads& block = blocks_.back();
    double const omega = 2.0 * std::numbers::pi * spring.frequency_hz;
    for (std::size_t k = lane; k < spring_lanes; ++k) {
      block.square[k] = omega * omega;
      block.decay[k] = spring.damping * omega;
      block.ringing[k] = omega * std::sqrt(1.0 - spring.damping * spring.damping);
      block.per_square[k] =
          spring.acceleration > 0.0 ? spring.hardening * std::pow(omega * omega / spring.acceleration, 2) : 0.0;
    }
  }

  std::size_t lanes_of(std::size_t block) const {
    return std::min(spring_lanes, springs_.size() - block * spring_lanes);
  }

  // as if the acceleration had been the same for long
  static void start(EightLoads& block, Accelerations const& ddq) {
    for (std::size_t k = 0; k < spring_lanes; ++k) {
      block.ddq[k] = ddq.is_common ? *ddq.first : ddq.first[k];
      block.y[k] = -block.ddq[k] / block.square[k];
      block.dy[k] = 0.0;
    }
  }

  // room: for those of a block that is not full
  Accelerations accelerations(JointStates const& at, std::size_t block, Eight& room) const {
    double const* const first = at.ddq.data() + block * spring_lanes;
    std::size_t const lanes = lanes_of(block);
    if (lanes == spring_lanes) return {first, false};
    room.fill(first[lanes - 1]);
    std::copy_n(first, lanes, room.begin());
    return {room.data(), false};
  }

  std::vector<EightSwings> const& swings_in(double step_s) {
    if (step_s == whole_step_s_) return *swings_;
    whole_step_s_ = step_s;
    swings_ = &steps_.of(step_s, [this](double whole_s) {
      std::vector<EightSwings> swings(blocks_.size());
      for (std::size_t lane = 0; lane < blocks_.size() * spring_lanes; ++lane)
        put_swing(springs_[std::min(lane, springs_.size() - 1)], whole_s, lane % spring_lanes,
                  swings[lane / spring_lanes]);
      return swings;
    });
    return *swings_;
  }

  static void put_swing(Spring const& spring, double whole_s, std::size_t k, EightSwings& swings) {
    double const omega = 2.0 * std::numbers::pi * spring.frequency_hz;
    double const decay = spring.damping * omega, ringing = omega * std::sqrt(1.0 - spring.damping * spring.damping);
    // kicks are stable up to 2 rad of the stiffest spring's swing
    bool const is_straight = !(spring.hardening > 0.0 && spring.acceleration > 0.0);
    double const stiffest = is_straight ? 0.0 : omega * std::sqrt(most_stiffening) * whole_s;
    double const parts = std::max(1.0, std::ceil(stiffest)), step_s = whole_s / parts;
    swings.parts[k] = parts;
    swings.step_s[k] = step_s;
    swings.faded[k] = std::exp(-decay * step_s);
    swings.cosine[k] = std::cos(ringing * step_s);
    swings.sine[k] = std::sin(ringing * step_s);
    swings.most_parts = std::max(swings.most_parts, parts);
  }

  std::vector<Spring> springs_{};  // one per lane
  std::vector<EightLoads> blocks_{};
  RememberedSteps<std::vector<EightSwings>> steps_{};
  double whole_step_s_ = 0.0;
  std::vector<EightSwings> const* swings_ = nullptr;  // of that step
  bool has_started_ = false;
};

}  // namespace

std::unique_ptr<EffectMemory> loads_on_spring(Spring const& spring, std::size_t lanes) {
  return std::make_unique<LoadsOnSpring>(spring, lanes);
}

}  // namespace torquescope::load_on_spring
#endif  // HWY_ONCE
