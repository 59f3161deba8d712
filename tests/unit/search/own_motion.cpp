// A load behind a spring whose resonance lies in the band: the motion of a twin without it misleads about its shape,
// the recording's own motion tells it; and a soft loop that rings because its current comes late. Both are integrated
// here, in small steps, by nothing of the engine's.

#include "engine/infer/search/own_motion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/base/random_stream.hpp"
#include "unit/replicates/clean_records.hpp"

using namespace torquescope;
using namespace torquescope::test;

namespace own_motion_test {

constexpr double load = 0.02, spring_hz = 9.0, spring_damping = 0.05;

struct Machine {
  double loop_hz = 12.0;
  bool has_soft_gear = true;
  double current_lag_s = 0.0;
  double knee = 0.0;  // wind-up that makes the gear twice as stiff; 0: it stays as it is
};

Recording recorded(Machine const& machine) {
  constexpr double motor = 0.016, viscous = 0.164, coulomb = 0.4, offset = -0.125, rate_hz = 1000.0, seconds = 16.0;
  constexpr int steps = 40;
  constexpr double step_s = 1.0 / (rate_hz * steps), omega = 2.0 * std::numbers::pi * spring_hz;
  constexpr double stiffness = load * omega * omega, damping = 2.0 * spring_damping * load * omega;
  double const loop = 2.0 * std::numbers::pi * machine.loop_hz;
  double const moved = machine.has_soft_gear ? motor : motor + load;
  double const encoder_step = 2.0 * std::numbers::pi / counts_per_revolution;
  RandomStream random({80, 0, RandomDomain::test}, 0, 0);

  Recording recording;
  recording.name = "machine";
  recording.rate_hz = rate_hz;
  recording.rows.encoder_step = encoder_step;
  auto const n = static_cast<Eigen::Index>(seconds * rate_hz);
  for (auto* channel : {&recording.time_s, &recording.position, &recording.torque, &recording.reference})
    channel->resize(n);
  double q = 0.0, dq = 0.0, q_load = 0.0, dq_load = 0.0, last = 0.0, last_wanted = 0.0, current = 0.0;
  for (Eigen::Index row = 0; row < n; ++row) {
    double const t = static_cast<double>(row) / rate_hz, ramp = std::min(1.0, t / 0.5);
    double wanted = std::sin(2.0 * t) + 0.4 * std::sin(5.3 * t);
    for (int wave = 2; wave < 14; ++wave)
      wanted += 0.006 * std::sin(2.0 * std::numbers::pi * 1.03 * wave * t + 1.7 * wave * wave);
    wanted *= ramp;
    double const measured = encoder_step * std::round(q / encoder_step);
    double const behind = wanted - measured, behind_rate = (wanted - last_wanted - measured + last) * rate_hz;
    last = measured, last_wanted = wanted;
    double const torque = (motor + load) * (loop * loop * behind + 1.4 * loop * behind_rate);
    recording.time_s[row] = t;
    recording.reference[row] = wanted;
    recording.position[row] = measured;
    recording.torque[row] = torque + 0.004 * random.normal();
    for (int step = 0; step < steps; ++step) {
      double const wound = q_load - q, stiffer = machine.knee > 0.0 ? std::pow(wound / machine.knee, 2) : 0.0;
      double const pull = machine.has_soft_gear ? stiffness * wound * (1.0 + stiffer) + damping * (dq_load - dq) : 0.0;
      current = machine.current_lag_s > 0.0 ? current + step_s * (torque - current) / machine.current_lag_s : torque;
      double const free = current + pull - viscous * dq - offset;
      double const sense = dq != 0.0 ? std::copysign(1.0, dq) : std::copysign(1.0, free);
      double const before = dq;
      if (dq != 0.0 || std::abs(free) > coulomb) dq += step_s * (free - sense * coulomb) / moved;
      if (before * dq < 0.0) dq = 0.0;
      q += step_s * dq;
      dq_load -= step_s * pull / load;
      q_load += step_s * dq_load;
    }
  }
  return recording;
}

class OwnMotion : public testing::Test {
 protected:
  EffectScan scan_of(char const* effect) const {
    EffectScan scan;
    scan.effect = find_effect(effect);
    scan.grid = shape_grid(*scan.effect, columns.twin.scales());
    scan.best_point = best_plausible_point(columns.twin, scan, mismatch, 2).value_or(0);
    scan.shape = scan.grid.point(scan.best_point);
    scan.is_testable = true;
    return scan;
  }

  OwnMotionShapes shapes_of(EffectScan const& scan) const { return {columns.recording, scan, mismatch, "de", 1, 2}; }

  explicit OwnMotion(Machine const& machine = {}) : recording(recorded(machine)) {}

  Recording const recording;
  FilterOptions const filter = clean_filter();
  Section const section{};
  StageSetting const setting{recording, clean_regressor(), filter, section, 64, 1, 2};
  ModelStage const stage = make_stage(setting, clean_regressor()).value();
  Eigen::VectorXd const mismatch = stage.mismatch();
  BothMotions const columns{stage};
};

TEST_F(OwnMotion, TellsTheResonanceThatATwinsMotionHides) {
  EffectScan const scan = scan_of("joint_elasticity");
  RefinedEffect const by_twin = refine_shape(columns.twin, scan, mismatch, shape_search("de", 1), 2);
  auto const own = shapes_of(scan).nearby();
  ASSERT_TRUE(own);
  EXPECT_GT(own->gain, by_twin.gain);
  EXPECT_NEAR(own->shape[0], spring_hz, 0.01 * spring_hz);
  EXPECT_NEAR(own->shape[1], spring_damping, 0.1 * spring_damping);
  EXPECT_NEAR(own->parameters[0], load, 0.05 * load);
  EXPECT_GT(std::abs(by_twin.shape[0] - spring_hz), 0.05 * spring_hz) << "then nothing was hidden";
}

class OwnMotionOfAStiffeningGear : public OwnMotion {
 protected:
  OwnMotionOfAStiffeningGear() : OwnMotion({12.0, true, 0.0, 0.006}) {}
};

TEST_F(OwnMotionOfAStiffeningGear, IsSearchedEverywhere) {
  EffectScan scan = scan_of("joint_elasticity");
  auto axes = scan.grid.axes;
  auto& frequencies = axes.front();
  frequencies = {frequencies.front(), frequencies[frequencies.size() / 2], frequencies.back()};  // point nowhere
  scan.grid = grid_over(scan.grid.ranges, axes, GridPoints::all);
  scan.best_point = 0;
  auto shapes = shapes_of(scan);
  auto const near = shapes.nearby(), own = shapes.everywhere();
  ASSERT_TRUE(own && near);
  EXPECT_GT(own->gain, 1.4 * near->gain) << "a soft gear that stiffens much, next to the grid's best point";
  EXPECT_LT(own->shape[2], 0.2 * near->shape[2]);
}

constexpr double current_lag_s = 0.012;

class OwnMotionOfALateCurrent : public OwnMotion {
 protected:
  OwnMotionOfALateCurrent() : OwnMotion({5.0, false, current_lag_s}) {}
};

TEST_F(OwnMotionOfALateCurrent, HasTheRingingThatATwinsMotionLacks) {
  EffectScan const scan = scan_of("actuator_lag");
  auto const own = shapes_of(scan).nearby();
  ASSERT_TRUE(own);
  // the law has no shape to look for, and what it explains is looked for all the same
  EXPECT_GT(own->gain, 1.2 * scan.gain);
  EXPECT_NEAR(own->parameters[0], current_lag_s, 0.25 * current_lag_s);
}

TEST_F(OwnMotion, IsNotAskedOfALawWithoutMemory) {
  EffectScan const scan = scan_of("stribeck");
  EXPECT_FALSE(shapes_of(scan).nearby());
  EXPECT_FALSE(shapes_of(scan).everywhere());
}

}  // namespace own_motion_test
