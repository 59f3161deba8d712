// First gains of a recording without noise are those of its loop; the loop's own answer is the recorded torque.

#include "engine/simulate/rollout/loop_gains.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "unit/rollout/recorded_joints.hpp"

using namespace torquescope;
using namespace torquescope::test;

namespace loop_gains_test {

std::vector<std::string> const forms{"p", "pi", "pd", "pid", "p_velocity", "p_pi"};
constexpr Sensors exact{.encoder_step = 0.0, .torque_noise = 0.0};
constexpr int samples = 1500;

void expect_true(PlainController const& controller, PlainInputs const& inputs, double share, std::string const& name) {
  std::vector<RolloutTrack> const tracks{recorded(dry_joint(), controller, inputs, exact)};
  LoopValues const values = free_loop(controller, tracks).values, truth = values_of(controller);
  for (LoopKey const key : gains_of(*loop_form_of(controller.form)))
    EXPECT_NEAR(values[key], truth[key], share * truth[key]) << name << " " << facts_of(key).name;
}

TEST(LoopGains, OfExactRecordingsAreTheTrueOnes) {
  // least squares on what the loop itself sees: nothing is left but rounding
  constexpr double exactly = 1e-3;
  for (auto const& form : forms) {
    expect_true(controller_of(form), moved(samples), exactly, form);
    PlainController changed = controller_of(form);
    changed.speed_lag_s = 0.01;
    changed.command_delay_s = 0.006;
    changed.log_lag_s = 0.004;
    changed.span = 2;
    expect_true(changed, moved(samples), exactly, form + ", lagging and late");
    changed = controller_of(form);
    changed.feed_speed = 0.7;
    changed.feed_acceleration = 0.03;
    PlainInputs inputs = moved(samples);
    for (int k = 0; k < samples; ++k) inputs.added.push_back(0.3 * std::sin(0.04 * k));
    expect_true(changed, inputs, exactly, form + ", fed forward");
  }
}

TEST(LoopGains, LeaveOutWhatIsAtTheLimit) {
  for (std::string const form : {"p", "pd", "p_velocity"}) {
    PlainController limited = controller_of(form);
    limited.limit = 0.8;
    PlainInputs inputs = moved(samples);
    for (int k = 0; k < samples; ++k) inputs.enabled.push_back(k % 500 < 450 ? 1.0 : 0.0);
    expect_true(limited, inputs, 0.03, form);
  }
}

TEST(LoopGains, ThatAreGivenStayAsTheyAre) {
  PlainController const controller = controller_of("p_pi");
  std::vector<RolloutTrack> const tracks{recorded(dry_joint(), controller, moved(samples), exact)};
  LoopValues values = values_of(controller);
  values[LoopKey::kv] = 0.0;
  LoopValues const found = with_first_gains(LoopForm::p_pi, values, {LoopKey::kv}, 1, tracks);
  EXPECT_EQ(found[LoopKey::kp], controller.kp);
  EXPECT_EQ(found[LoopKey::ki], controller.ki);
  EXPECT_NEAR(found[LoopKey::kv], controller.kv, 0.01 * controller.kv);
}

TEST(LoopError, OfTheTrueLoopIsNearNothing) {
  for (auto const& form : forms) {
    PlainController const controller = controller_of(form);
    RolloutTrack const track = recorded(dry_joint(), controller, moved(samples), exact);
    LoopNumbers const numbers = trial_of(dry_joint(), controller).loop;
    if (numbers.ki != 0.0) {
      EXPECT_TRUE(std::isnan(loop_error(numbers, 1, track))) << form << ": a sum of errors runs away";
      continue;
    }
    EXPECT_LT(loop_error(numbers, 1, track), 1e-9) << form;
    LoopNumbers wrong = numbers;
    wrong.kp *= 0.9;
    EXPECT_GT(loop_error(wrong, 1, track), 0.02) << form;
  }
  // by hand: a torque wrong by a constant
  RolloutTrack track = recorded(dry_joint(), controller_of("pd"), moved(samples), exact);
  LoopNumbers const numbers = trial_of(dry_joint(), controller_of("pd")).loop;
  track.torque.array() += 0.1;
  EXPECT_NEAR(loop_error(numbers, 1, track), 0.1 * std::sqrt(samples) / track.torque.norm(), 1e-3);
}

TEST(LoopError, OfAnIdentifiedControllerIsNearNothing) {
  PlainController const controller = controller_of("pd");
  RolloutTrack const track = recorded(dry_joint(), controller, moved(samples), exact);
  // kp (r - q) - kd (q - q before) rate
  LoopController identified;
  double const by_speed = controller.kd * track.rate_hz;
  identified.position = {-controller.kp - by_speed, by_speed};
  identified.reference = {0.0, controller.kp, 0.0};
  EXPECT_LT(loop_error(identified, track), 1e-9);
}

// rounding makes long differences look better than the one that the controller takes
TEST(LoopGains, TellTheSpanOfTheSpeedInSpiteOfRounding) {
  for (int const span : {1, 2, 5})
    for (double const step : {1e-7, 1e-4}) {
      PlainController controller = controller_of("pd");
      controller.span = span;
      Sensors const sensors{step, 1e-3, 3};
      std::vector<RolloutTrack> const tracks{recorded(dry_joint(), controller, moved(3000), sensors)};
      LoopValues const values = values_of(controller);
      std::size_t const found = speed_span(LoopForm::pd, values, {}, tracks);
      // the controller itself reads by steps: what it answered is no rounding of the recording
      EXPECT_EQ(found, static_cast<std::size_t>(span)) << step;
    }
}

}  // namespace loop_gains_test
