#include "engine/diagnose/arms/rigid_corrections.hpp"

#include <string>

#include "engine/effects/given_effect.hpp"
#include "engine/fit/problem/covariance_root.hpp"
#include "engine/fit/statistics/scaled_solution.hpp"

namespace torquescope {

Eigen::MatrixXd own_columns(Motion const& joint) {
  Eigen::MatrixXd own(joint.q.size(), 4);
  own << joint.ddq, joint.dq, joint.dq.array().sign().matrix(), Eigen::VectorXd::Ones(joint.q.size());
  return own;
}

void CorrectionSums::add(Motion const& joint, Eigen::MatrixXd const& error_torques) {
  Eigen::MatrixXd const own = own_columns(joint);
  if (samples_ == 0) {
    errors_.setZero(error_torques.cols(), error_torques.cols());
    beside_.setZero(own.cols(), error_torques.cols());
    own_.setZero(own.cols(), own.cols());
  }
  errors_ += error_torques.transpose() * error_torques;
  beside_ += own.transpose() * error_torques;
  own_ += own.transpose() * own;
  samples_ += joint.q.size();
}

RigidCorrections CorrectionSums::corrections(double noise, Eigen::Index rows) const {
  constexpr double told_by_joint = 0.5;  // of what is known: most of it
  RigidCorrections corrections;
  if (samples_ == 0 || errors_.cols() == 0 || rows == 0) return corrections;
  Eigen::MatrixXd const imitated = solve_scaled(own_, beside_);
  Eigen::MatrixXd const left = errors_ - beside_.transpose() * imitated;
  double const samples_per_row = static_cast<double>(samples_) / static_cast<double>(rows);
  corrections.directions = largest_axes(left, told_by_joint * noise * noise * samples_per_row);
  corrections.own = imitated * corrections.directions;
  return corrections;
}

Eigen::MatrixXd correction_columns(RigidCorrections const& corrections, Motion const& joint,
                                   Eigen::MatrixXd const& error_torques) {
  return error_torques * corrections.directions - own_columns(joint) * corrections.own;
}

std::unique_ptr<Effect const> correction_term(Eigen::Index directions) {
  constexpr double far = 1e3;  // standard deviations
  EffectDescription description;
  description.name = corrections_name;
  description.title = "correction of the rigid arm at this joint";
  description.equation = "sum c_k (tau_k less what the joint's own terms imitate)";
  description.source = "Frisch, Waugh 1933";
  for (Eigen::Index k = 0; k < directions; ++k)
    description.parameters.push_back(
        {std::string(corrections_name) + "_" + std::to_string(k + 1), "1", "1", {-far}, {far}});
  return std::make_unique<GivenEffect const>(std::move(description));
}

}  // namespace torquescope
