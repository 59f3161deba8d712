// What is left out of the fit judges it: an effect that is there helps in blocks it was not fitted to, one that is not
// does not, and an effect that lives in one block alone does not blow up.

#include "engine/fit/statistics/blocked_cv.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <vector>

#include "engine/base/random_stream.hpp"
#include "engine/data/zero_phase.hpp"
#include "support/decompositions.hpp"

namespace torquescope {
namespace blocked_cv_test {

constexpr Eigen::Index n = 1000, guard = 20;

struct Drawn {
  Eigen::VectorXd noise;
  Eigen::MatrixXd model, effect;
};

// noise of variance 1; model and effect: waves and their own noise, different in every set
Drawn drawn(std::uint32_t set, Eigen::Index effect_width = 1) {
  RandomStream stream({41, set, RandomDomain::test}, 0, 0);
  Drawn made{Eigen::VectorXd(n), Eigen::MatrixXd(n, 2), Eigen::MatrixXd(n, effect_width)};
  for (double& value : made.noise) value = stream.normal();
  for (Eigen::MatrixXd* part : {&made.model, &made.effect})
    for (Eigen::Index k = 0; k < part->cols(); ++k) {
      double const period = stream.uniform(10.0, 80.0), phase = stream.uniform(0.0, 6.0);
      for (Eigen::Index i = 0; i < n; ++i)
        (*part)(i, k) = std::sin(static_cast<double>(i) / period + phase) + 0.3 * stream.normal();
    }
  return made;
}

// rows far enough from a block, copied one by one
Eigen::VectorXd left_by_rows(Eigen::VectorXd const& y, Eigen::MatrixXd const& x, Eigen::Index block) {
  Eigen::Index const from = n / 10 * block, to = from + n / 10;
  std::vector<Eigen::Index> outside, inside;
  for (Eigen::Index i = 0; i < n; ++i) {
    if (i >= from && i < to) inside.push_back(i);
    if (i < from - guard || i >= to + guard) outside.push_back(i);
  }
  Eigen::MatrixXd const fit = x(outside, Eigen::all);
  Eigen::VectorXd const theta = test::least_squares(fit, y(outside));
  return y(inside) - x(inside, Eigen::all) * theta;
}

Eigen::MatrixXd both_of(Eigen::MatrixXd const& model, Eigen::MatrixXd const& effect) {
  Eigen::MatrixXd both(n, model.cols() + effect.cols());
  both << model, effect;
  return both;
}

// energy that the effect's column explains where it was not fitted
double gain_of(Eigen::VectorXd const& mismatch, Eigen::MatrixXd const& model, Eigen::MatrixXd const& effect) {
  return blocked_residuals(mismatch, model, guard).squaredNorm() -
         blocked_residuals(mismatch, both_of(model, effect), guard).squaredNorm();
}

TEST(BlockedResiduals, AreThoseOfTenFitsWithoutTheBlockAndItsGuard) {
  auto const [noise, model, effect] = drawn(1, 2);
  for (auto const& columns : {model, both_of(model, effect)}) {
    Eigen::VectorXd const found = blocked_residuals(noise, columns, guard);
    for (Eigen::Index block = 0; block < 10; ++block) {
      Eigen::VectorXd const expected = left_by_rows(noise, columns, block);
      EXPECT_LT((found.segment(n / 10 * block, n / 10) - expected).norm(), 1e-9) << block;
    }
  }
}

TEST(BlockedResiduals, AreLessByTheEnergyOfAnEffectThatIsThere) {
  for (std::uint32_t set = 0; set < 50; ++set) {
    auto const [noise, model, effect] = drawn(set);
    Eigen::VectorXd const beside = test::left_beside(model, effect);
    // the cross term with the noise is 2 * 0.5 * ||beside|| * N(0, 1)
    double const energy = 0.25 * beside.squaredNorm();
    EXPECT_NEAR(gain_of(noise + 0.5 * effect.col(0), model, effect), energy, 4.0 * std::sqrt(energy) * 2.0) << set;
  }
}

TEST(BlockedResiduals, AreNotLessOnAverageByAnEffectThatIsNotThere) {
  constexpr std::uint32_t sets = 400;
  double gain = 0.0, squares = 0.0;
  for (std::uint32_t set = 0; set < sets; ++set) {
    auto const [noise, model, effect] = drawn(1000 + set);
    double const found = gain_of(noise, model, effect);
    gain += found / sets;
    squares += found * found / sets;
  }
  double const error = std::sqrt((squares - gain * gain) / sets);
  EXPECT_LT(gain, 3.0 * error);       // a fitted coefficient predicts worse than none: below 0
  EXPECT_GT(gain, -2.0 - 3 * error);  // by one degree of freedom, twice: fitted outside, judged inside
}

TEST(BlockedResiduals, OfAnEventInOneBlockAreTheEventItself) {
  auto const [noise, model, effect] = drawn(3);
  Eigen::MatrixXd event = Eigen::MatrixXd::Zero(n, 1);
  event.middleRows(540, 20).setOnes();  // inside block 5, and its neighbours' guards do not reach it
  Eigen::VectorXd const mismatch = noise + 3.0 * event.col(0);
  Eigen::VectorXd const before = blocked_residuals(mismatch, model, guard),
                        after = blocked_residuals(mismatch, both_of(model, event), guard);
  // outside it has nothing to be fitted to, elsewhere nothing to predict
  EXPECT_LT((after - before).segment(500, 100).norm(), 1e-9);
  EXPECT_TRUE(after.allFinite());
}

// the same event as the search sees it: through the parallel filter (30 Hz of 200 Hz, guard as guard_rows() says).
// Beyond the guard 1e-10 of the event is left; noise fitted to that must not predict 1e9 inside the block
TEST(BlockedResiduals, OfAFilteredEventInOneBlockDoNotBlowUp) {
  auto const [noise, model, effect] = drawn(3);
  Eigen::VectorXd pulse = Eigen::VectorXd::Zero(n);
  pulse.segment(540, 20).setOnes();
  Eigen::MatrixXd const event = zero_phase(butterworth_lowpass(4, 30.0, 200.0), pulse);
  Eigen::VectorXd const mismatch = noise + 3.0 * event.col(0);
  // a coefficient fitted to the filter's ringing alone would be as wrong as the ringing is small
  EXPECT_LT(blocked_residuals(mismatch, both_of(model, event), guard).segment(500, 100).squaredNorm(),
            2.0 * mismatch.segment(500, 100).squaredNorm());
}

}  // namespace blocked_cv_test
}  // namespace torquescope
