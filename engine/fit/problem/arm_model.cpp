#include "engine/fit/problem/arm_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <utility>

#include "engine/base/contract.hpp"
#include "engine/effects/passive_signs.hpp"

namespace torquescope {
namespace {

// the rigid arm has masses and weights of its own
void refuse_rigid_bodies(std::vector<std::string> const& friction, Section const& place) {
  for (auto const& name : friction) {
    auto const* effect = find_effect(name);
    if (effect == nullptr || !effect->is_rigid_body()) continue;
    throw Error(problem_at(place, "friction", fmt::format("\"{}\" is part of the rigid arm already", name),
                           "remove it: friction = [\"viscous\", \"coulomb\", \"offset\"]; inertias of drives are "
                           "drive_inertia = true"));
  }
}

std::vector<std::optional<Regressor>> friction_of(SerialChain const& chain, ArmTerms const& terms,
                                                  Section const& model) {
  std::vector<std::optional<Regressor>> friction(chain.joints.size());
  for (std::size_t j = 0; j < friction.size(); ++j) {
    auto const& own = terms.joint_friction.empty() ? terms.friction : terms.joint_friction[j];
    auto const& place = terms.joint_sections.empty() ? model : terms.joint_sections[j];
    refuse_rigid_bodies(own, place);
    if (!own.empty()) friction[j].emplace(own, chain.joints[j].kind, terms.velocity_deadband, place);
  }
  return friction;
}

}  // namespace

ArmModel::ArmModel(SerialChain chain, ArmTerms const& terms, Section const& model)
    : chain_(std::move(chain)),
      terms_(terms),
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
    if (!friction_[j]) continue;
    for (auto column : friction_[j]->column_owners()) {
      for (std::size_t const row : joints_of_motor(j)) own_[row].push_back(static_cast<Eigen::Index>(columns_.size()));
      column.name += fmt::format("_{}", j + 1);
      columns_.push_back(std::move(column));
    }
  }
  first_effect_ = std::ssize(columns_);
  add_effect_columns();
  for (auto const& payload : terms.payloads) payloads_.push_back(payload_columns(chain_, base_, payload));
  add_payload_columns();
  if (terms.drive_gains) add_gain_columns();
}

double ArmModel::turns(std::size_t motor, std::size_t joint) const {
  if (!chain_.has_coupled_drives()) return motor == joint ? 1.0 : 0.0;
  return chain_.transmission(static_cast<Eigen::Index>(motor), static_cast<Eigen::Index>(joint));
}

std::vector<std::size_t> ArmModel::joints_of_motor(std::size_t motor) const {
  std::vector<std::size_t> joints;
  for (std::size_t j = 0; j < chain_.joints.size(); ++j)
    if (turns(motor, j) != 0.0) joints.push_back(j);
  return joints;
}

std::vector<std::size_t> ArmModel::motors_of_joint(std::size_t joint) const {
  std::vector<std::size_t> motors;
  for (std::size_t m = 0; m < chain_.joints.size(); ++m)
    if (turns(m, joint) != 0.0) motors.push_back(m);
  return motors;
}

std::size_t ArmModel::friction_alone(std::size_t joint) const {
  bool const is_alone = motors_of_joint(joint).size() == 1 && !chain_.is_coupled(static_cast<Eigen::Index>(joint));
  return is_alone && friction_[joint] ? friction_[joint]->size() : 0;
}

Motion ArmModel::motor_motion(std::vector<Motion> const& motion, std::size_t motor) const {
  Motion turned = motion[motor];
  for (auto signal : {&Motion::q, &Motion::dq, &Motion::ddq}) {
    (turned.*signal).setZero();
    for (std::size_t const j : joints_of_motor(motor)) turned.*signal += turns(motor, j) * (motion[j].*signal);
  }
  return turned;
}

ArmModel ArmModel::with_effects(std::vector<HeldEffect> effects) const {
  ArmTerms terms = terms_;
  terms.effects = std::move(effects);
  return {chain_, terms, Section{"model", {}, {}}};
}

void ArmModel::add_effect_columns() {
  for (auto const& effect : terms_.effects)
    for (std::size_t k = 0; k < effect.effect->n_linear(); ++k) {
      auto const& parameter = effect.effect->parameters()[k];
      RegressorColumn column{fmt::format("{}_{}", parameter.name, effect.joint + 1),
                             parameter.unit_for(chain_.joints[effect.joint].kind)};
      column.needs_velocity = true;
      for (std::size_t const row : joints_of_motor(effect.joint)) own_[row].push_back(std::ssize(columns_));
      columns_.push_back(std::move(column));
    }
}

std::vector<Eigen::MatrixXd> ArmModel::effect_columns(HeldEffect const& held, std::vector<Motion> const& motion,
                                                      std::vector<Eigen::MatrixXd> const& rows) const {
  bool const is_coupled = chain_.is_coupled(static_cast<Eigen::Index>(held.joint));
  Motion const moved = is_coupled ? motor_motion(motion, held.joint) : motion[held.joint];
  EffectInput input{moved, held.scales};
  Eigen::VectorXd load, all;
  if (held.effect->needs_baseline()) {
    auto const& own = own_[held.joint];
    auto const count = std::lower_bound(own.begin(), own.end(), first_effect_) - own.begin();
    Eigen::VectorXd values = Eigen::VectorXd::Zero(count);
    for (Eigen::Index k = 0; k < count && held.baseline.size() > 0; ++k)
      values[k] = held.baseline[own[static_cast<std::size_t>(k)]];
    auto const rigid = std::ssize(rigid_parameters(held.joint));
    load = rows[held.joint].leftCols(rigid) * values.head(rigid);
    all = rows[held.joint].leftCols(count) * values;
    auto const n = static_cast<std::size_t>(load.size());
    input.load_torque = {load.data(), n};
    input.model_torque = {all.data(), n};
  }
  Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(moved.q.size(), static_cast<Eigen::Index>(held.effect->n_linear()));
  if (held.effect->takes_shape(held.shape.size())) held.effect->columns(input, held.shape, columns);
  std::vector<Eigen::MatrixXd> of_joints(joints());
  for (std::size_t const j : joints_of_motor(held.joint)) of_joints[j] = turns(held.joint, j) * columns;
  return of_joints;
}

void ArmModel::add_payload_columns() {
  for (std::size_t p = 0; p < payloads_.size(); ++p)
    for (std::size_t k = 0; k < payloads_[p].names.size(); ++k) {
      RegressorColumn column{fmt::format("payload{}_{}", p + 1, payloads_[p].names[k]), payloads_[p].units[k]};
      column.needs_position = column.needs_velocity = column.needs_acceleration = true;
      for (auto& own : own_) own.push_back(static_cast<Eigen::Index>(columns_.size()));
      columns_.push_back(std::move(column));
    }
}

void ArmModel::add_gain_columns() {
  for (std::size_t j = 0; j < joints(); ++j) {
    gains_.push_back(static_cast<Eigen::Index>(columns_.size()));
    own_[j].push_back(gains_.back());
    columns_.push_back({fmt::format("gain_error_{}", j + 1), "1"});
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
    if (!friction) continue;
    auto const own = torquescope::passive_signs(*friction);
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
  std::vector<std::string> effects;
  for (auto const& friction : friction_) {
    std::string const own = friction ? friction->equation() : "=";
    effects.push_back(own.substr(own.find('=') + 1));
  }
  if (std::all_of(effects.begin(), effects.end(), [](auto const& effect) { return effect.empty(); })) return text;
  bool const are_alike =
      std::all_of(effects.begin(), effects.end(), [&](auto const& effect) { return effect == effects.front(); });
  return text + " +" + (are_alike ? effects.front() + " in each joint" : " friction of each joint");
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
  if (chain_.has_coupled_drives()) fill_coupled_drives(motion, rows);
}

void ArmModel::fill_coupled_drives(std::vector<Motion> const& motion, std::vector<Eigen::MatrixXd>& rows) const {
  Eigen::Index const links = numbers_per_link * chain_.size();
  for (std::size_t j = 0; j < joints(); ++j) {
    auto const rigid = rigid_parameters(j);
    // the kernel's columns stand side by side: from the last one to its place
    auto from = static_cast<Eigen::Index>(rigid_.columns(static_cast<Eigen::Index>(j)).size());
    for (auto place = std::ssize(rigid) - 1; place >= 0; --place) {
      Eigen::Index const column = base_.columns()[static_cast<std::size_t>(rigid[static_cast<std::size_t>(place)])];
      if (column >= links && chain_.is_coupled(column - links)) {
        auto const motor = static_cast<std::size_t>(column - links);
        rows[j].col(place) = turns(motor, j) * motor_motion(motion, motor).ddq;
      } else if (--from != place) {
        rows[j].col(place) = rows[j].col(from);
      }
    }
  }
}

std::vector<Eigen::Index> ArmModel::rigid_parameters(std::size_t joint) const {
  auto const& own = own_[joint];
  return {own.begin(), std::lower_bound(own.begin(), own.end(), base_.size())};
}

Eigen::VectorXd ArmModel::known_torque(std::size_t joint, Eigen::MatrixXd const& rows, std::size_t payload) const {
  auto const rigid = rigid_parameters(joint);
  return rows.leftCols(static_cast<Eigen::Index>(rigid.size())) * payloads_[payload].known(rigid);
}

std::vector<Eigen::MatrixXd> ArmModel::rows(std::vector<Motion> const& motion,
                                            std::optional<std::size_t> payload) const {
  TORQUESCOPE_EXPECT(motion.size() == joints());
  Eigen::Index const n = motion.front().q.size();
  std::vector<Eigen::MatrixXd> rows;
  for (std::size_t j = 0; j < joints(); ++j) {
    TORQUESCOPE_EXPECT(motion[j].q.size() == n);
    rows.emplace_back(Eigen::MatrixXd::Zero(n, static_cast<Eigen::Index>(own_[j].size())));
  }
  fill_rigid(motion, rows);
  std::vector<Eigen::Index> places;
  for (std::size_t j = 0; j < joints(); ++j) places.push_back(std::ssize(rigid_parameters(j)));
  for (std::size_t m = 0; m < joints(); ++m) {
    if (!friction_[m]) continue;
    bool const is_coupled = chain_.is_coupled(static_cast<Eigen::Index>(m));
    Eigen::MatrixXd const columns = friction_[m]->columns(is_coupled ? motor_motion(motion, m) : motion[m]);
    for (std::size_t const j : joints_of_motor(m)) {
      rows[j].middleCols(places[j], columns.cols()) = turns(m, j) * columns;
      places[j] += columns.cols();
    }
  }
  for (auto const& effect : terms_.effects) {
    auto const columns = effect_columns(effect, motion, rows);
    for (std::size_t j = 0; j < joints(); ++j) {
      if (columns[j].size() == 0) continue;
      rows[j].middleCols(places[j], columns[j].cols()) = columns[j];
      places[j] += columns[j].cols();
    }
  }
  for (std::size_t j = 0; j < joints(); ++j) {
    auto const rigid = rigid_parameters(j);
    Eigen::Index next = places[j];
    for (std::size_t p = 0; p < payloads_.size(); ++p) {
      auto const& unknown = payloads_[p].unknown;
      if (payload == p)
        rows[j].middleCols(next, unknown.cols()) =
            rows[j].leftCols(static_cast<Eigen::Index>(rigid.size())) * unknown(rigid, Eigen::all);
      next += unknown.cols();
    }
    if (!gains_.empty()) rows[j].col(next) = -motion[j].torque;
  }
  return rows;
}

}  // namespace torquescope
