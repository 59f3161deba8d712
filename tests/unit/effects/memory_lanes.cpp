// Replicates that go side by side are each what they would be alone, to the last bit: every lane has a motion and a
// memory of its own.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>
#include <vector>

#include "engine/effects/memory_effect.hpp"
#include "unit/effects/smooth_motion.hpp"

namespace torquescope {
namespace memory_lanes_test {

constexpr std::size_t n_lanes = 16;
constexpr int n_steps = 400;
constexpr double step_s = 1e-3;

// lane k runs later and slower, and rests now and then
JointState state_of(std::size_t lane, int step) {
  int const moving = step % 100 < 80 ? step : step - step % 100 + 80;
  JointState state =
      test::smooth_state(0.37 * static_cast<double>(lane) + (0.2 + 0.1 * static_cast<double>(lane)) * moving * step_s);
  state.time_s = step * step_s;
  if (moving != step) state.dq = 0.0;
  state.load_torque = 0.3 * state.q;
  state.motor_torque = state.load_torque + 0.1 * state.dq;
  return state;
}

struct Lanes {
  Eigen::ArrayXd time_s{n_lanes}, q{n_lanes}, dq{n_lanes}, ddq{n_lanes}, load{n_lanes}, motor{n_lanes};

  explicit Lanes(int step) {
    for (std::size_t lane = 0; lane < n_lanes; ++lane) {
      JointState const state = state_of(lane, step);
      auto const at = static_cast<Eigen::Index>(lane);
      time_s[at] = state.time_s, q[at] = state.q, dq[at] = state.dq;
      ddq[at] = state.ddq, load[at] = state.load_torque, motor[at] = state.motor_torque;
    }
  }
  JointStates states() const {
    auto const view = [](Eigen::ArrayXd const& values) {
      return JointStates::Quantity(values.data(), static_cast<Eigen::Index>(n_lanes));
    };
    return {view(time_s), view(q), view(dq), view(ddq), view(load), view(motor)};
  }
};

std::vector<MemoryEffect const*> memories() {
  std::vector<MemoryEffect const*> found;
  for (Effect const* effect : effect_choices())
    if (auto const* memory = dynamic_cast<MemoryEffect const*>(effect)) found.push_back(memory);
  return found;
}

TEST(MemoryLanes, AreThoseOfEachByItself) {
  ASSERT_GE(memories().size(), 6U);
  test::KnownJoint const joint;
  Motion motion = test::motion_of(test::smooth_state, 2000, 500.0);
  JointScales const scales = joint.baseline(motion).scales;
  for (MemoryEffect const* effect : memories()) {
    auto const parameters = test::parameters_with(*effect, test::shape_between(*effect, scales));
    std::span<double const> const all(parameters);
    auto const width = static_cast<Eigen::Index>(effect->n_linear());
    Eigen::ArrayXXd const linear =
        Eigen::Map<Eigen::ArrayXXd const>(parameters.data(), 1, width).replicate(Eigen::Index{n_lanes}, 1);
    auto const together = effect->memory(all.subspan(effect->n_linear()), scales, n_lanes);
    std::vector<std::unique_ptr<EffectRunner>> alone;
    for (std::size_t lane = 0; lane < n_lanes; ++lane) alone.push_back(effect->runner(parameters, scales));
    double largest = 0.0;
    for (int step = 0; step < n_steps; ++step) {
      Lanes const at(step);
      together->advance(at.states(), step_s);
      std::vector<double> torques(n_lanes);
      together->torques(at.states(), linear, torques);
      for (std::size_t lane = 0; lane < n_lanes; ++lane) {
        alone[lane]->advance(state_of(lane, step), step_s);
        ASSERT_EQ(torques[lane], alone[lane]->torque(state_of(lane, step))) << effect->name() << " lane " << lane;
        largest = std::max(largest, std::abs(torques[lane]));
      }
    }
    EXPECT_GT(largest, 0.0) << effect->name();
  }
}

}  // namespace memory_lanes_test
}  // namespace torquescope
