// What one recording has and another has not stands out by a smooth function of that recording alone.

#include "engine/infer/decision/smooth_correction.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/infer/decision/fitted_model.hpp"
#include "unit/decision/plants.hpp"

using namespace torquescope;
using namespace torquescope::test;

namespace smooth_correction_test {

struct Best {
  SignatureAxis axis = SignatureAxis::position;
  double gain = 0.0, rms = 0.0;
};

// the one of largest D, of two recordings, the second of which may have an effect of its own
Best found(std::function<double(double q, double dq)> const& in_second) {
  GivenJoint joint;
  std::vector<Recording> training{recording_of(joint)};
  joint.pace = 0.87;
  joint.seed = 2;
  joint.effect = in_second;
  training.push_back(recording_of(joint));
  Regressor const terms = joint_terms();
  FilterOptions const filter = ten_hertz();
  Section const section{};
  JointStrips const rows = joint_strips({training, {}, terms, filter, section});
  FittedModel const model = fitted_model(rows, terms, {}, nullptr, {DelaySearch::everywhere, 0.15});
  SmoothCorrections const all =
      smooth_corrections(*model.fitted, {model.fitted->base(), model.fitted->residual(), model.fitted->guard()});
  Eigen::Index most = 0;
  all.gains.maxCoeff(&most);
  return {all.axes[static_cast<std::size_t>(most)], all.gains[most], all.rms[most]};
}

TEST(SmoothCorrection, SeesWhatOneOfTwoRecordingsHas) {
  Best const sound = found({}), sprung = found([](double q, double) { return 0.3 * std::sin(3.0 * q); });
  EXPECT_EQ(sprung.axis, SignatureAxis::position);
  EXPECT_GT(sprung.gain, 5.0 * sound.gain);
  EXPECT_GT(sprung.rms, 0.1);
}

}  // namespace smooth_correction_test
