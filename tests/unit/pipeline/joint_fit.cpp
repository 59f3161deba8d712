// Whatever the torque is, the fitted joint is one: where least squares would give it less inertia or friction than none
// it is held, and the other parameters are those of least squares beside that.

#include "engine/infer/pipeline/joint_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/effects/regressor.hpp"

namespace torquescope {
namespace joint_fit_test {

struct Rows {
  Regressor regressor;
  ProcessedRecord record;
  JointModel model{regressor};

  explicit Rows(std::vector<std::string> const& terms) : regressor(terms, JointKind::revolute) {
    Motion motion;
    motion.rate_hz = 100.0;
    motion.time_s = Eigen::VectorXd::LinSpaced(4000, 0.0, 39.99);
    auto const t = motion.time_s.array();
    motion.q = (1.3 * t).sin() + 0.4 * (3.1 * t + 0.3).sin();
    motion.dq = 1.3 * (1.3 * t).cos() + 1.24 * (3.1 * t + 0.3).cos();
    motion.ddq = -1.69 * (1.3 * t).sin() - 3.844 * (3.1 * t + 0.3).sin();
    motion.torque = Eigen::VectorXd::Zero(4000);
    record.columns = regressor.columns(motion);
    record.motion = std::move(motion);
  }

  void fit(Eigen::VectorXd torque) {
    record.torque = std::move(torque);
    fit_joint(record, model, "made up");
  }
};

TEST(JointFit, OfASoundJointIsLeastSquares) {
  Rows rows({"inertia", "viscous", "coulomb", "offset"});
  Eigen::Vector4d const truth(0.3, 0.8, 1.1, -0.2);
  rows.fit(rows.record.columns * truth);
  EXPECT_LE((rows.record.parameters - truth).norm(), 1e-10);
  EXPECT_EQ(rows.record.held, "");
  EXPECT_EQ(rows.record.columns.cols(), 4) << "lent columns are given back";
}

TEST(JointFit, HoldsAnInertiaThatAMissingWeightTookAway) {
  Rows rows({"inertia", "viscous", "coulomb", "offset"});
  Eigen::VectorXd const weight = 5.0 * rows.record.motion.q.array().sin();
  Eigen::Vector4d const truth(0.05, 0.8, 1.1, 0.0);
  rows.fit(rows.record.columns * truth + weight);
  EXPECT_EQ(rows.record.held, "inertia");
  EXPECT_GT(rows.record.parameters[0], 0.0);
  // beside the held inertia nothing is left that the other columns could take
  Eigen::VectorXd const unexplained = rows.record.columns.rightCols(3).transpose() * rows.record.residual;
  EXPECT_LE(unexplained.cwiseAbs().maxCoeff(), 1e-8 * rows.record.torque.norm());
}

TEST(JointFit, FrictionThatWouldDriveTheJointIsAnOffset) {
  Rows rows({"inertia", "viscous", "coulomb_positive", "coulomb_negative"});
  Eigen::Vector4d const driving(0.3, 0.8, -0.4, 0.2);
  rows.fit(rows.record.columns * driving);
  EXPECT_EQ(rows.record.held, "dry friction");
  EXPECT_EQ(rows.record.parameters[2], rows.record.parameters[3]);
  Rows single({"inertia", "viscous", "coulomb"});
  single.fit(single.record.columns * Eigen::Vector3d(0.3, 0.8, -0.4));
  EXPECT_EQ(single.record.held, "dry friction");
  EXPECT_EQ(single.record.parameters[2], 0.0);
}

}  // namespace joint_fit_test
}  // namespace torquescope
