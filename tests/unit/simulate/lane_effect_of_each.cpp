// Effects of trials that differ from lane to lane: each lane has what it would have alone, to the last bit.

#include "engine/simulate/lane_effect.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <string>
#include <vector>

using namespace torquescope;

namespace lane_effect_of_each_test {

JointScales scales() {
  JointScales made;
  made.rate_hz = 1000.0;
  made.duration_s = 2.0;
  made.peak_speed = 2.0;
  made.position_range = 3.0;
  made.inertia = 0.05;
  made.viscous = 0.1;
  made.coulomb_positive = 0.3;
  made.coulomb_negative = 0.2;
  return made;
}

LaneInstant instant(int tick) {
  LaneInstant at;
  at.step_s = 1e-3;
  at.time_s = tick * at.step_s;
  for (std::size_t lane = 0; lane < replicate_lanes; ++lane) {
    double const phase = 0.03 * tick + 0.4 * static_cast<double>(lane);
    at.q[lane] = std::sin(phase);
    at.dq[lane] = 30.0 * std::cos(phase);
    at.ddq[lane] = -900.0 * std::sin(phase);
    at.motor_torque[lane] = 3.0 * std::cos(2.0 * phase);
  }
  return at;
}

// joints of their own, so that a controller which follows the load sees which lane is which
LaneBaseline baseline() {
  LaneBaseline made;
  for (std::size_t lane = 0; lane < replicate_lanes; ++lane) {
    double const more = 1.0 + 0.1 * static_cast<double>(lane);
    made.joint.set(lane, {0.05 * more, 0.1, 0.6 * more, -0.2});
  }
  return made;
}

Eigen::ArrayXXd rows_of(std::vector<std::vector<double>> const& parameters) {
  Eigen::ArrayXXd rows(static_cast<Eigen::Index>(parameters.size()),
                       static_cast<Eigen::Index>(parameters.front().size()));
  for (Eigen::Index lane = 0; lane < rows.rows(); ++lane)
    for (Eigen::Index k = 0; k < rows.cols(); ++k)
      rows(lane, k) = parameters[static_cast<std::size_t>(lane)][static_cast<std::size_t>(k)];
  return rows;
}

// three sets of parameters in an order without a pattern
std::vector<std::vector<double>> parameters_of(Effect const& effect) {
  auto const ranges = effect.shape_bounds(scales());
  std::vector<std::vector<double>> lanes;
  for (std::size_t lane = 0; lane < replicate_lanes; ++lane) {
    auto const which = static_cast<double>(lane * lane % 7 % 3);
    std::vector<double> parameters(effect.n_linear(), 0.1 + 0.07 * which);
    for (auto const& range : ranges)
      parameters.push_back(range.lower + (0.3 + 0.2 * which) * (range.upper - range.lower));
    lanes.push_back(parameters);
  }
  return lanes;
}

struct Answer {
  LaneDemand demand{};
  double position[replicate_lanes] = {}, torque[replicate_lanes] = {};
};

Answer answer(LaneEffect& effect, LaneInstant const& at) {
  Answer given;
  effect.add(at, given.demand);
  effect.shift_position(at, given.position);
  effect.shift_torque(at, given.torque);
  return given;
}

bool same_in_lane(Answer const& a, Answer const& b, std::size_t lane) {
  double const ours[] = {a.demand.smooth[lane],   a.demand.inertia[lane], a.demand.forward[lane],
                         a.demand.backward[lane], a.position[lane],       a.torque[lane]};
  double const theirs[] = {b.demand.smooth[lane],   b.demand.inertia[lane], b.demand.forward[lane],
                           b.demand.backward[lane], b.position[lane],       b.torque[lane]};
  return std::memcmp(ours, theirs, sizeof ours) == 0;
}

bool is_anything(Answer const& one, std::size_t lane) {
  return one.demand.smooth[lane] != 0.0 || one.demand.inertia[lane] != 0.0 || one.demand.forward[lane] != 0.0 ||
         one.demand.backward[lane] != 0.0 || one.position[lane] != 0.0 || one.torque[lane] != 0.0;
}

TEST(LaneEffectOfEach, OfEveryLaneIsThatOfTheLaneAlone) {
  int effects = 0, with_memory = 0, with_load = 0;
  for (auto const* effect : effect_choices()) {
    if (effect->is_given() || effect->is_of_whole_arm()) continue;
    auto const parameters = parameters_of(*effect);
    auto const together = lane_effect_of_each(*effect, rows_of(parameters), scales(), baseline())();
    std::vector<std::unique_ptr<LaneEffect>> alone;
    for (auto const& one : parameters) alone.push_back(lane_effect(*effect, one, scales(), baseline())());
    EXPECT_EQ(together->follows_steps(), alone[0]->follows_steps()) << effect->name();
    bool acts = false;
    for (int tick = 0; tick < 200; ++tick) {
      LaneInstant const at = instant(tick);
      Answer const all = answer(*together, at);
      for (std::size_t lane = 0; lane < replicate_lanes; ++lane) {
        Answer const own = answer(*alone[lane], at);
        ASSERT_TRUE(same_in_lane(all, own, lane)) << effect->name() << ", lane " << lane << ", tick " << tick;
        acts = acts || is_anything(own, lane);
      }
    }
    EXPECT_TRUE(acts || effect->is_event()) << effect->name();
    ++effects;
    with_memory += effect->has_memory() ? 1 : 0;
    with_load += effect->needs_baseline() ? 1 : 0;
  }
  EXPECT_GT(effects, 30);
  EXPECT_GE(with_memory, 3);
  EXPECT_GE(with_load, 2);
}

TEST(LaneEffectOfEach, MadeAgainBeginsAnew) {
  Effect const& effect = *find_effect("presliding");
  auto const make = lane_effect_of_each(effect, rows_of(parameters_of(effect)), scales(), baseline());
  auto const first = make();
  Answer fresh = answer(*first, instant(0));
  for (int tick = 1; tick < 50; ++tick) answer(*first, instant(tick));
  Answer const later = answer(*first, instant(0)), again = answer(*make(), instant(0));
  for (std::size_t lane = 0; lane < replicate_lanes; ++lane) EXPECT_TRUE(same_in_lane(fresh, again, lane));
  EXPECT_FALSE(same_in_lane(fresh, later, 0));
}

}  // namespace lane_effect_of_each_test
