// Names of what a scan took: waves of one effect are one name, the delay is last, each number stands with its own.

#include "engine/diagnose/effect_names.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <utility>

#include "unit/pipeline/clean_records.hpp"

using namespace torquescope;
using namespace torquescope::test;
using ::testing::ElementsAre;

namespace effect_names_test {

// of a model with effects, whose numbers are 1, 2, 3 and so on
JointDecision decision_with(Recording const& recording, std::vector<EffectFacts> effects) {
  static FilterOptions const filter = clean_filter();
  static Section const section{};
  static Regressor const regressor = clean_regressor();
  JointDecision decision;
  decision.rows = joint_strips({{&recording, 1}, {}, regressor, filter, section});
  DelayChoice const as_read{DelaySearch::given, 0.0, 0.0};
  FittedModel const plain = fitted_model(decision.rows, regressor, {}, nullptr, as_read);
  std::vector<ShapedEffect> shaped;
  std::size_t numbers = regressor.size();
  for (auto const& one : effects) {
    shaped.push_back({one.effect, one.shape});
    numbers += one.effect->parameters().size();
  }
  decision.final = fitted_model(decision.rows, regressor, std::move(shaped), plain.fitted.get(), as_read);
  decision.final_replicates = Eigen::MatrixXd::Zero(decision.final.fitted->residual().size(), 8);
  for (std::size_t k = 0; k < numbers; ++k) decision.facts.parameters.push_back({static_cast<double>(k + 1), 0.0});
  decision.facts.accepted = std::move(effects);
  return decision;
}

EffectFacts taken(char const* name, std::vector<double> shape, std::vector<char const*> const& rivals) {
  EffectFacts facts{find_effect(name), std::move(shape)};
  facts.gain = 49.0;
  facts.p = 0.02;
  for (auto const* rival : rivals) facts.rivals.push_back(find_effect(rival));
  return facts;
}

std::vector<std::string> names_in(std::vector<ParameterEstimate> const& estimates) {
  std::vector<std::string> names;
  for (auto const& one : estimates) names.push_back(one.name);
  return names;
}

std::vector<double> values_in(std::vector<ParameterEstimate> const& estimates) {
  std::vector<double> values;
  for (auto const& one : estimates) values.push_back(one.value);
  return values;
}

TEST(EffectNames, AreOneForWavesOfOneEffectAndTheDelayIsLast) {
  Recording const recording = recorded(simulate_joint(clean_joint().plan, 3));
  JointDecision decision =
      decision_with(recording, {taken("cogging", {6.0}, {"torque_ripple"}), taken("asymmetric_viscous", {}, {}),
                                taken("cogging", {9.0}, {"torque_ripple", "encoder_eccentricity"})});
  decision.facts.delay.is_named = true;
  decision.facts.delay.late_s = -0.004;
  EffectNames const names = names_of_scan(decision);
  ASSERT_EQ(names.effects.size(), 3U);
  NamedEffect const &waves = names.effects[0], &friction = names.effects[1], &delay = names.effects[2];
  EXPECT_EQ(waves.name, "cogging");
  EXPECT_THAT(waves.equivalent, ElementsAre("torque_ripple", "encoder_eccentricity"));
  EXPECT_EQ(waves.z, 7.0);
  EXPECT_EQ(waves.p, 0.02);
  std::size_t const terms = clean_regressor().size();
  auto const at = [&](std::size_t k) { return static_cast<double>(terms + k + 1); };
  // linear numbers of all effects come before their shapes
  EXPECT_THAT(values_in(waves.parameters), ElementsAre(at(0), at(1), at(5), at(3), at(4), at(6)));
  EXPECT_EQ(waves.parameters[3].name, waves.parameters[0].name + "_2");
  EXPECT_THAT(values_in(friction.parameters), ElementsAre(at(2)));
  EXPECT_THAT(names_in(delay.parameters), ElementsAre("delay"));
  EXPECT_THAT(values_in(delay.parameters), ElementsAre(-0.004));
  EXPECT_EQ(names.parameters.size(), terms + 8);
  EXPECT_EQ(names.parameters.back().name, "delay");
}

}  // namespace effect_names_test
