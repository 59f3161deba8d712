// The code of an effect, compiled by a C compiler, against the engine's own columns.

#include "engine/effects/instant_code.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>

#include "engine/effects/given_effect.hpp"
#include "tests/unit/effects/instant_code.h"

namespace torquescope {
namespace instant_code_test {

double from(std::mt19937& random, double lower, double upper) {
  return std::uniform_real_distribution<double>(lower, upper)(random);
}

TEST(Code, IsTheTorqueOfTheEffect) {
  constexpr double rounding = 1e-12;  // of torques of a few N m
  std::mt19937 random(44);
  std::set<std::string> seen;
  for (CodedEffect const* coded = coded_effects; coded->effect; ++coded) {
    Effect const& effect = *find_effect(coded->effect);
    seen.insert(effect.name());
    double largest = 0.0;
    for (int draw = 0; draw < 300; ++draw) {
      JointScales scales;
      scales.coulomb_positive = from(random, 0.1, 1.0);
      scales.coulomb_negative = draw % 10 == 0 ? scales.coulomb_positive : from(random, 0.1, 1.0);
      scales.inertia = from(random, 0.1, 2.0);
      JointState state{from(random, 0, 9),  from(random, -2, 2), from(random, -2, 2),
                       from(random, -3, 3), from(random, -2, 2), from(random, -2, 2)};
      if (draw == 7) state.dq = 0.0;
      std::vector<double> parameters;
      for (auto const& parameter : effect.parameters())
        parameters.push_back(from(random, parameter.sign() == Sign::any ? -2.0 : 0.1, 2.0) *
                             (parameter.is_shape && parameter.sign() == Sign::any ? 0.5 : 1.0));
      for (auto& parameter : parameters)
        if (effect.n_shape() > 0 && &parameter >= &parameters[effect.n_linear()] && !effect.has_plain_form())
          parameter = std::abs(parameter) + 0.05;
      auto const given = std::span(parameters).first(coded->is_plain ? effect.n_linear() : parameters.size());
      double const expected = effect.torque(state, given, scales);
      double const sign = (state.dq > 0.0) - (state.dq < 0.0);
      double const found = coded->torque(parameters.data(), state.q, state.dq, state.ddq, sign,
                                         scales.friction_sign()(state.dq), state.load_torque, scales.inertia);
      EXPECT_NEAR(found, expected, rounding * std::max(1.0, std::abs(expected))) << effect.name();
      largest = std::max(largest, std::abs(expected));
    }
    EXPECT_GT(largest, 0.05) << effect.name();
  }
  EXPECT_GE(seen.size(), 15u);
}

TEST(Code, IsThereOrAReasonIsGiven) {
  for (auto const* choices : {&effect_choices(), &arm_effect_choices()})
    for (auto const* effect : *choices) {
      EXPECT_EQ(effect->code().empty(), !why_no_code(*effect).empty()) << effect->name();
      EXPECT_EQ(effect->plain_code().empty(), effect->code().empty() || !effect->has_plain_form()) << effect->name();
      for (auto const& parameter : effect->parameters())
        EXPECT_TRUE(effect->code().empty() || has_word(effect->code(), parameter.name)) << parameter.name;
    }
}

TEST(Words, AreWholeOnes) {
  EXPECT_TRUE(has_word("pow(dq, 2)", "dq"));
  EXPECT_FALSE(has_word("pow(ddq, 2) + friction_sign", "dq"));
  EXPECT_FALSE(has_word("friction_sign", "s"));
  EXPECT_EQ(with_words("a * cos(a_b * q)", {{"a", "a_2"}, {"a_b", "a_b_2"}}), "a_2 * cos(a_b_2 * q)");
}

}  // namespace instant_code_test
}  // namespace torquescope
