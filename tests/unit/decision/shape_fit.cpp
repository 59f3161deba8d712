// Shapes of a model are where the squares are least, wherever the search for one effect alone had left them.

#include "engine/infer/decision/shape_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "unit/decision/plants.hpp"

using namespace torquescope;
using namespace torquescope::test;

namespace shape_fit_test {

struct Shaped {
  std::vector<Recording> training{};
  Regressor terms = joint_terms();
  FilterOptions filter = ten_hertz();
  Section section{};
  JointStrips rows{};
  FittedModel plain{};

  explicit Shaped(std::function<double(double q, double dq)> effect) {
    GivenJoint joint;
    joint.effect = std::move(effect);
    training = {recording_of(joint)};
    rows = joint_strips({training, {}, terms, filter, section});
    plain = fitted({});
  }
  FittedModel fitted(std::vector<ShapedEffect> effects) const {
    return fitted_model(rows, terms, std::move(effects), plain.fitted.get(), {DelaySearch::everywhere, 0.15});
  }
  FittedModel from(std::vector<ShapedEffect> effects) const {
    return with_fitted_shapes(fitted(std::move(effects)),
                              [this](std::vector<ShapedEffect> trial) { return fitted(std::move(trial)); });
  }
};

double squares(FittedModel const& by) { return by.fitted->chosen().fit.energy(); }

TEST(ShapeFit, FindsTwoShapesAtOnce) {
  Shaped const joint([](double q, double dq) {
    double const peak = std::exp(-std::pow(dq / 0.3, 2.0));
    return 0.4 * peak * (dq > 0.0 ? 1.0 : -1.0) + 0.1 * std::sin(7.0 * q + 0.4);
  });
  std::vector<ShapedEffect> const begun{{find_effect("stribeck"), {0.5, 2.0}}, {find_effect("cogging"), {7.1}}};
  FittedModel const before = joint.fitted(begun), after = joint.from(begun);
  EXPECT_LT(squares(after), 0.5 * squares(before));
  EXPECT_NEAR(after.model->effects()[0].shape[0], 0.3, 0.03);
  EXPECT_NEAR(after.model->effects()[1].shape[0], 7.0, 0.02);
}

TEST(ShapeFit, AModelWithoutShapesStays) {
  Shaped const joint([](double, double dq) { return 0.03 * std::abs(dq); });
  FittedModel const before = joint.fitted({{find_effect("asymmetric_viscous"), {}}});
  EXPECT_EQ(squares(joint.from({{find_effect("asymmetric_viscous"), {}}})), squares(before));
}

}  // namespace shape_fit_test
