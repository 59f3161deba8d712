#include "engine/diagnose/arms/rigid_columns.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "engine/base/dense_solvers.hpp"
#include "engine/diagnose/arms/arm_effects.hpp"
#include "engine/effects/given_effect.hpp"
#include "engine/fit/statistics/scaled_solution.hpp"
#include "engine/infer/pipeline/held_torque.hpp"

namespace torquescope {
namespace {

// places of the joint's rigid parameters among parameters_of(joint)
std::vector<Eigen::Index> rigid_places(ArmModel const& model, std::size_t joint) {
  auto const& own = model.parameters_of(joint);
  auto const& gains = model.gain_columns();
  auto const first = std::lower_bound(own.begin(), own.end(), model.base().size()) - own.begin();
  auto const friction = static_cast<std::ptrdiff_t>(model.friction_alone(joint));
  std::vector<Eigen::Index> places;
  for (std::ptrdiff_t k = 0; k < std::ssize(own); ++k) {
    bool const is_friction = k >= first && k < first + friction;
    bool const is_gain = std::find(gains.begin(), gains.end(), own[static_cast<std::size_t>(k)]) != gains.end();
    if (!is_friction && !is_gain) places.push_back(k);
  }
  return places;
}

Eigen::MatrixXd stacked(std::vector<Eigen::MatrixXd> const& parts, std::size_t count) {
  Eigen::Index rows = 0, row = 0;
  for (std::size_t i = 0; i < count; ++i) rows += parts[i].rows();
  Eigen::MatrixXd all(rows, parts.front().cols());
  for (std::size_t i = 0; i < count; row += parts[i++].rows()) all.middleRows(row, parts[i].rows()) = parts[i];
  return all;
}

// what a joint's own terms imitate: acceleration, speed, its sign, a constant; n x 4
Eigen::MatrixXd own_columns(Motion const& joint) {
  Eigen::MatrixXd own(joint.q.size(), 4);
  own << joint.ddq, joint.dq, joint.dq.array().sign().matrix(), Eigen::VectorXd::Ones(joint.q.size());
  return own;
}

// those that the ones before do not imitate, of columns that may be of any length
std::vector<Eigen::Index> independent(Eigen::MatrixXd columns, Eigen::VectorXd const& whole_lengths) {
  constexpr double same = 1e-5;  // of a column's length: what is left is rounding
  std::vector<Eigen::Index> kept;
  for (Eigen::Index k = 0; k < columns.cols(); ++k) {
    if (!kept.empty()) {
      Eigen::MatrixXd const before = columns(Eigen::all, kept);
      columns.col(k) = beside_columns(before, columns.col(k));
    }
    if (columns.col(k).norm() > same * whole_lengths[k]) kept.push_back(k);
  }
  return kept;
}

}  // namespace

std::vector<Eigen::Index> rigid_parameters(ArmModel const& model, std::size_t joint) {
  std::vector<Eigen::Index> parameters;
  for (Eigen::Index const place : rigid_places(model, joint))
    parameters.push_back(model.parameters_of(joint)[static_cast<std::size_t>(place)]);
  return parameters;
}

std::vector<Recording> joints_with_rigid_rows(ArmModel const& model, RecordedArm const& recording,
                                              ArmFilter const& filter) {
  auto const motion = motion_of(recording, filter);
  auto const rows = model.rows(motion, recording.payload);
  auto effects = arm_effect_signals(model, motion);
  std::vector<Recording> joints = recording.joints;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    if (recording.payload) {
      Eigen::VectorXd const known = model.known_torque(j, rows[j], *recording.payload);
      joints[j].torque -= torque_to_hold(known);
      joints[j].gear_load = joints[j].gear_load.size() > 0 ? (joints[j].gear_load + known).eval() : known;
    }
    effects[j].effects.push_back({rigid_rows_name, rows[j](Eigen::all, rigid_places(model, j))});
    joints[j].given = std::make_shared<GivenSignals const>(std::move(effects[j]));
  }
  return joints;
}

std::unique_ptr<Effect const> rigid_term(char const* name, Eigen::Index columns) {
  constexpr double far = 1e9;
  EffectDescription description;
  description.name = name;
  description.title = "what the arm does to this joint";
  description.equation = "y_j(q, dq, ddq) chi";
  description.source = "Gautier, Khalil 1990";
  description.is_rigid_body = true;
  for (Eigen::Index k = 0; k < columns; ++k)
    description.parameters.push_back({std::string(name) + "_" + std::to_string(k + 1), "1", "1", {-far}, {far}});
  return std::make_unique<GivenEffect const>(std::move(description));
}

Eigen::Index add_rigid_arm(std::vector<Recording>& recordings, std::size_t training,
                           Eigen::MatrixXd const& combinations, ArmFilter const& filter) {
  std::vector<Eigen::MatrixXd> whole, own;
  for (auto const& one : recordings) {
    whole.emplace_back(*one.given->of(rigid_rows_name) * combinations);
    own.push_back(own_columns(differentiate(one, filter.options, filter.section)));
  }
  Eigen::MatrixXd const trained = stacked(whole, training), own_trained = stacked(own, training);
  Eigen::MatrixXd const imitated = solve_scaled(own_trained, trained);
  auto const kept = independent(trained - own_trained * imitated, trained.colwise().norm());
  Eigen::RowVectorXd const inertia = imitated.row(0);
  Eigen::VectorXd const sizes =
      (trained - own_trained.col(0) * inertia).colwise().norm() / std::sqrt(static_cast<double>(trained.rows()));
  for (std::size_t i = 0; i < recordings.size(); ++i) {
    Eigen::MatrixXd columns = (whole[i] - own[i].col(0) * inertia)(Eigen::all, kept);
    // of one N m in the rms
    for (std::size_t k = 0; k < kept.size(); ++k) columns.col(static_cast<Eigen::Index>(k)) /= sizes[kept[k]];
    GivenSignals given = *recordings[i].given;
    given.effects.push_back({rigid_arm_name, std::move(columns)});
    recordings[i].given = std::make_shared<GivenSignals const>(std::move(given));
  }
  return std::ssize(kept);
}

}  // namespace torquescope
