#include "engine/fit/excite/fourier_motion.hpp"

#include <numbers>

#include "engine/base/contract.hpp"
#include "kernels/elementary.hpp"

namespace torquescope {

using Eigen::Index;

FourierTable::FourierTable(Index samples, Index harmonics) : cosine(samples, harmonics), sine(samples, harmonics) {
  Eigen::VectorXd place(samples);
  for (Index i = 0; i < samples; ++i) place[i] = static_cast<double>(i) / static_cast<double>(samples);
  for (Index k = 0; k < harmonics; ++k)
    kernels::cosine_sine_of_multiple(2.0 * std::numbers::pi * static_cast<double>(k + 1), place.data(),
                                     static_cast<std::size_t>(samples), cosine.col(k).data(), sine.col(k).data());
}

MotionSamples samples_of(FourierMotion const& motion, FourierTable const& table) {
  Index const n = table.cosine.rows(), harmonics = table.cosine.cols();
  auto const joints = static_cast<Index>(motion.joints.size());
  double const omega = 2.0 * std::numbers::pi / motion.period_s;
  Eigen::ArrayXd const speeds = omega * Eigen::ArrayXd::LinSpaced(harmonics, 1.0, static_cast<double>(harmonics));
  MotionSamples samples{Eigen::VectorXd(n), Eigen::MatrixXd(n, joints), Eigen::MatrixXd(n, joints),
                        Eigen::MatrixXd(n, joints)};
  for (Index i = 0; i < n; ++i) samples.time_s[i] = motion.period_s * static_cast<double>(i) / static_cast<double>(n);
  for (Index j = 0; j < joints; ++j) {
    auto const& joint = motion.joints[static_cast<std::size_t>(j)];
    TORQUESCOPE_EXPECT(joint.cosine.size() == harmonics && joint.sine.size() == harmonics);
    Eigen::VectorXd const a = joint.cosine, b = joint.sine, over = speeds.inverse().matrix(), by = speeds.matrix();
    samples.q.col(j) = table.sine * a.cwiseProduct(over) - table.cosine * b.cwiseProduct(over);
    samples.q.col(j).array() += joint.centre;
    samples.dq.col(j) = table.cosine * a + table.sine * b;
    samples.ddq.col(j) = table.cosine * b.cwiseProduct(by) - table.sine * a.cwiseProduct(by);
  }
  return samples;
}

}  // namespace torquescope
