#include "engine/problem/arm_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <utility>

#include "engine/base/contract.hpp"
#include "engine/effects/passive_signs.hpp"

namespace torquescope {
namespace {

std::vector<Regressor> friction_of(SerialChain const& chain, ArmTerms const& terms, Section const& model) {
  std::vector<Regressor> friction;
  if (terms.friction.empty()) return friction;
  for (auto const& joint : chain.joints)
    friction.emplace_back(terms.friction, joint.kind, terms.velocity_deadband, model);
  return friction;
}

}  // namespace

ArmModel::ArmModel(SerialChain chain, ArmTerms const& terms, Section const& model)
    : chain_(std::move(chain)),
      drives_(terms.drives),
      base_(chain_, terms.drives),
      rigid_(chain_, base_, std::vector<FrictionColumns>(chain_.joints.size(), {false, false, false})),
      friction_(friction_of(chain_, terms, model)),
      own_(chain_.joints.size()) {
  for (Eigen::Index k = 0; k < base_.size(); ++k) {
    auto const& parameter = base_.parameters()[static_cast<std::size_t>(k)];
    RegressorColumn column{parameter.name, parameter.unit};
    column.needs_position = column.needs_velocity = column.needs_acceleration = true;
    columns_.push_back(std::move(column));
    for (Eigen::Index j = parameter.first_row; j <= parameter.last_row; ++j)
      own_[static_cast<std::size_t>(j)].push_back(k);
  }
  for (std::size_t j = 0; j < friction_.size(); ++j) {
    for (auto column : friction_[j].column_owners()) {
      own_[j].push_back(static_cast<Eigen::Index>(columns_.size()));
      column.name += fmt::format("_{}", j + 1);
      columns_.push_back(std::move(column));
    }
  }
}

Eigen::VectorXd ArmModel::passive_signs() const {
  Eigen::VectorXd signs = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(size()));
  auto const links = static_cast<Eigen::Index>(10 * joints());
  for (Eigen::Index k = 0; k < base_.size(); ++k) {
    auto const& parameter = base_.parameters()[static_cast<std::size_t>(k)];
    if (parameter.column >= links && parameter.gathers.empty()) signs[k] = 1.0;
  }
  Eigen::Index first = base_.size();
  for (auto const& friction : friction_) {
    auto const own = torquescope::passive_signs(friction);
    signs.segment(first, own.size()) = own;
    first += own.size();
  }
  return signs;
}

std::vector<std::string> ArmModel::names() const {
  std::vector<std::string> names;
  for (auto const& column : columns_) names.push_back(column.name);
  return names;
}

std::vector<std::string> ArmModel::units() const {
  std::vector<std::string> units;
  for (auto const& column : columns_) units.push_back(column.unit);
  return units;
}

std::vector<std::string> ArmModel::joint_names() const {
  std::vector<std::string> names;
  for (auto const& joint : chain_.joints) names.push_back(joint.name);
  return names;
}

std::string ArmModel::torque_unit(std::size_t joint) const {
  return chain_.joints[joint].kind == JointKind::revolute ? "N m" : "N";
}

std::string ArmModel::equation() const {
  std::string text = "tau = Phi(q, dq, ddq) chi";
  if (friction_.empty()) return text;
  std::string const own = friction_.front().equation();
  return text + " +" + own.substr(own.find('=') + 1) + " in each joint";
}

void ArmModel::fill_rigid(std::vector<Motion> const& motion, std::vector<Eigen::MatrixXd>& rows) const {
  auto const numbers = [](Eigen::VectorXd const& signal) {
    return std::span<double const>(signal.data(), static_cast<std::size_t>(signal.size()));
  };
  std::vector<JointSamples> samples;
  // nobody asks for the torque
  for (auto const& joint : motion)
    samples.push_back({numbers(joint.q), numbers(joint.dq), numbers(joint.ddq), numbers(joint.dq)});
  rigid_.fill(samples, rows);
}

std::vector<Eigen::MatrixXd> ArmModel::rows(std::vector<Motion> const& motion) const {
  TORQUESCOPE_EXPECT(motion.size() == joints());
  Eigen::Index const n = motion.front().q.size();
  std::vector<Eigen::MatrixXd> rows;
  for (std::size_t j = 0; j < joints(); ++j) {
    TORQUESCOPE_EXPECT(motion[j].q.size() == n);
    rows.emplace_back(n, static_cast<Eigen::Index>(own_[j].size()));
    if (!friction_.empty())
      rows[j].rightCols(static_cast<Eigen::Index>(friction_[j].size())) = friction_[j].columns(motion[j]);
  }
  fill_rigid(motion, rows);
  return rows;
}

}  // namespace torquescope
