// The verdict on many recordings, from facts alone: every row of its table.

#include "engine/infer/decision/servo_verdict.hpp"

#include <gtest/gtest.h>

using namespace torquescope;

namespace servo_verdict_test {

constexpr ServoFit alike{1e-3, 1e-3}, apart{3e-3, 1e-3};

KeptMove kept(LoopKey key, std::vector<LoopSubject> rivals = {}) { return {{nullptr, key}, 50.0, 0.02, {}, rivals}; }

LoopFacts facts_with(std::vector<KeptMove> moves, LoopReason reason = LoopReason::decides) {
  LoopFacts facts;
  facts.reason = reason;
  facts.kept = std::move(moves);
  return facts;
}

TEST(ServoVerdict, IsInsufficientWhereSimulationsDoNotDecide) {
  for (LoopReason const reason :
       {LoopReason::no_reference, LoopReason::no_controller, LoopReason::diverges, LoopReason::predicts_nothing})
    for (ServoFit const& fit : {alike, apart}) {
      EXPECT_EQ(servo_verdict(facts_with({}, reason), fit), Verdict::insufficient);
      EXPECT_EQ(servo_verdict(facts_with({kept(LoopKey::punch)}, reason), fit), Verdict::insufficient);
    }
}

TEST(ServoVerdict, WithoutANameSaysWhetherAnythingIsMissing) {
  EXPECT_EQ(servo_verdict(facts_with({}), alike), Verdict::none);
  EXPECT_EQ(servo_verdict(facts_with({}), apart), Verdict::unexplained);
}

TEST(ServoVerdict, NamesWhatStandsAlone) {
  auto const facts = facts_with({kept(LoopKey::command_delay_s), kept(LoopKey::load_friction)});
  EXPECT_EQ(servo_verdict(facts, alike), Verdict::named);
  EXPECT_EQ(servo_verdict(facts, apart), Verdict::partly);
}

TEST(ServoVerdict, IsAClassWhereAnyNameHasARival) {
  KeptMove const rivalled = kept(LoopKey::command_delay_s, {{nullptr, LoopKey::torque_lag_s}});
  for (auto const& moves : {std::vector{rivalled}, std::vector{kept(LoopKey::load_friction), rivalled},
                            std::vector{rivalled, kept(LoopKey::load_friction)}}) {
    EXPECT_EQ(servo_verdict(facts_with(moves), alike), Verdict::one_of_class);
    EXPECT_EQ(servo_verdict(facts_with(moves), apart), Verdict::partly);
  }
}

TEST(ServoVerdict, IsAdequateUpToTwiceWhatReplicatesDiffer) {
  EXPECT_TRUE((ServoFit{2.0, 1.0}.is_adequate()));
  EXPECT_FALSE((ServoFit{2.0001, 1.0}.is_adequate()));
  EXPECT_FALSE((ServoFit{1e-9, 0.0}.is_adequate()));
  // no number is no adequate fit
  EXPECT_FALSE((ServoFit{std::nan(""), 1.0}.is_adequate()));
}

}  // namespace servo_verdict_test
