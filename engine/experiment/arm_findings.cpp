#include "engine/experiment/arm_findings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "engine/data/arm_recording.hpp"
#include "engine/data/levels.hpp"
#include "engine/experiment/fit_findings.hpp"
#include "engine/experiment/torque_findings.hpp"
#include "engine/fit/problem/arm_regression.hpp"
#include "engine/robot/forward_dynamics.hpp"

namespace torquescope {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

std::string list_of(std::vector<std::string> const& names, std::vector<Index> const& which) {
  std::vector<std::string> chosen;
  for (auto const k : which) chosen.push_back(names[static_cast<std::size_t>(k)]);
  return fmt::format("{}", fmt::join(chosen, ", "));
}

// the joints that stand still, or never turn round
std::string wanted_motion(Experiment::Parts const& parts) {
  std::vector<std::string> still, one_way;
  auto const names = parts.arm->model.joint_names();
  for (std::size_t j = 0; j < parts.joints(); ++j) {
    double moving = 0.0;
    Index reversals = 0;
    for (std::size_t k = j; k < parts.train.excitation.size(); k += parts.joints()) {
      moving = std::max(moving, parts.train.excitation[k].moving_share);
      reversals += parts.train.excitation[k].reversals;
    }
    bool const has_rows = parts.arm->grams[j].rows > 0;
    if (moving == 0.0 || !has_rows)
      still.push_back(joint_title(j, names));
    else if (reversals == 0)
      one_way.push_back(joint_title(j, names));
  }
  std::string text;
  if (!still.empty()) text += fmt::format("; move {}", fmt::join(still, ", "));
  if (!one_way.empty()) text += fmt::format("; reverse {}", fmt::join(one_way, ", "));
  return text;
}

// positions of all joints at every instant of which all joints have a row
std::vector<VectorXd> positions_of(DataSet const& set, std::size_t joints) {
  std::map<Index, std::pair<VectorXd, std::size_t>> at;
  for (auto const* rows : {&set.regression, &set.other_rows}) {
    if (rows->q.size() != rows->rows()) continue;
    for (std::size_t k = 0; k < rows->recordings(); ++k)
      for (Index t = rows->first_row[k]; t < rows->first_row[k + 1]; ++t) {
        auto& [q, count] = at[rows->arm->instant[static_cast<std::size_t>(t)]];
        if (count == 0) q.setZero(static_cast<Index>(joints));
        q[static_cast<Index>(rows->arm->joint[k])] = rows->q[t];
        ++count;
      }
  }
  std::vector<VectorXd> positions;
  for (auto& [instant, value] : at)
    if (value.second == joints) positions.push_back(std::move(value.first));
  return positions;
}

// [N][R]: M_jj(q) of each parameter alone
MatrixXd own_inertias(ArmModel const& model, VectorXd const& q) {
  auto const& base = model.base();
  MatrixXd columns(q.size(), base.size());
  for (Index k = 0; k < base.size(); ++k)
    columns.col(k) = mass_matrix(model.chain(), base.to_standard(VectorXd::Unit(base.size(), k)), q).diagonal();
  return columns;
}

// the most negative M_jj of each joint along the motion, and the arm's positions there; 0 where none is negative
struct LeastInertias {
  VectorXd least;
  std::vector<VectorXd> where;
};

LeastInertias least_inertias(Experiment::Parts const& parts, VectorXd const& parameters) {
  auto const& model = parts.arm->model;
  VectorXd const standard = model.base().to_standard(parameters.head(model.base().size()));
  auto const joints = static_cast<Index>(model.joints());
  LeastInertias found{VectorXd::Zero(joints), std::vector<VectorXd>(model.joints())};
  for (auto const& q : positions_of(parts.train, model.joints())) {
    VectorXd const own = mass_matrix(model.chain(), standard, q).diagonal();
    for (Index j = 0; j < joints; ++j)
      if (own[j] < found.least[j]) {
        found.least[j] = own[j];
        found.where[static_cast<std::size_t>(j)] = q;
      }
  }
  return found;
}

// a torque below this share of the recorded one is rounding of a fit
constexpr double rounding = 1e-9;

// [R] parameters below these are zeros
VectorXd zeros_of(RegressionData const& rows) {
  VectorXd const lengths = rows.phi.colwise().norm().transpose();
  return rounding * rows.tau.norm() * lengths.cwiseMax(std::numeric_limits<double>::min()).cwiseInverse();
}

// those that are surely negative; "" where none is
std::string negative_inertias(ArmModel const& model, LeastInertias const& inertias, MatrixXd const& covariance,
                              VectorXd const& zeros) {
  auto const count = model.base().size();
  std::string words;
  for (Index j = 0; j < inertias.least.size(); ++j) {
    double const least = inertias.least[j];
    if (least >= 0.0) continue;
    VectorXd const gradient = own_inertias(model, inertias.where[static_cast<std::size_t>(j)]).row(j).transpose();
    double const error = std::sqrt(gradient.dot(covariance.topLeftCorner(count, count) * gradient));
    double const zero = gradient.cwiseAbs().dot(zeros.head(count));
    if (!(least < -std::max(levels::surely_negative * error, zero))) continue;
    bool const turns = model.chain().joints[static_cast<std::size_t>(j)].kind == JointKind::revolute;
    words += fmt::format("{}inertia of joint {} = {:.3g} {}", words.empty() ? "" : ", ", j + 1, least,
                         turns ? "kg m^2" : "kg");
  }
  return words;
}

}  // namespace

std::string word(Seen seen) { return seen == Seen::alone ? "alone" : seen == Seen::in_a_group ? "group" : "no"; }

ArmIdentifiability arm_identifiability(Experiment::Parts const& parts) {
  auto const& phi = parts.train.regression.phi;
  auto const found = gram_identifiability(phi.transpose() * phi);
  auto const names = parts.parameter_names();
  std::size_t alone = 0, grouped = 0;
  std::vector<Index> not_seen;
  for (std::size_t k = 0; k < found.seen.size(); ++k) {
    alone += found.seen[k] == Seen::alone;
    grouped += found.seen[k] == Seen::in_a_group;
    if (found.seen[k] == Seen::not_at_all) not_seen.push_back(static_cast<Index>(k));
  }
  ArmIdentifiability said;
  said.seen = found.seen;
  said.all_seen = alone == names.size();
  said.words = fmt::format("{} parameters: {} alone, {} only in a group, {} not at all", names.size(), alone, grouped,
                           not_seen.size());
  for (auto const& group : found.groups) said.words += fmt::format("; together: {}", list_of(names, group));
  if (!not_seen.empty()) said.words += fmt::format("; not seen: {}", list_of(names, not_seen));
  if (!said.all_seen) said.words += wanted_motion(parts);
  return said;
}

namespace {

std::optional<Finding> negative_finding(Experiment::Parts const& parts, RecordingOptions const& options) {
  auto const& all = parts.train.regression;
  if (!parts.health.identifiable || is_computed(parts.train.recordings)) return {};
  // with gains among the parameters, least squares of noisy torques is nearly that of none: zeros of either sign
  bool const has_gains = !all.arm->gain_column.empty();
  auto const stated = has_gains ? std::optional(with_stated_gains(all)) : std::nullopt;
  auto const& rows = has_gains ? *stated : all;
  VectorXd const parameters = has_gains ? solve_weighted(rows, {}) : solve_reduced(rows, parts.reductions);
  VectorXd const signs = parts.arm->model.passive_signs().head(rows.parameters());
  auto const inertias = least_inertias(parts, parameters);
  // errors cost as much as a fit: asked for only where something is negative
  if (signs.cwiseProduct(parameters).minCoeff() >= 0.0 && inertias.least.minCoeff() >= 0.0) return {};
  auto const fit = fit_with_errors(rows, parameters);
  VectorXd const zeros = zeros_of(rows);
  Finding finding{FindingKind::less_than_none, Grade::warning};
  finding.recording = parts.train.recordings.front().name;
  for (Index i = 0; i < signs.size(); ++i) {
    if (!(signs[i] * fit.parameters[i] < -std::max(levels::surely_negative * fit.standard_error[i], zeros[i])))
      continue;
    ++finding.count;
    auto const& column = rows.columns[static_cast<std::size_t>(i)];
    finding.detail += fmt::format("{}{} = {:.3g} {}", finding.detail.empty() ? "" : ", ", column.name,
                                  fit.parameters[i], column.unit);
  }
  std::string const negative = negative_inertias(parts.arm->model, inertias, fit.covariance_hac, zeros);
  if (!negative.empty()) {
    ++finding.count;
    finding.grade = Grade::fault;
    finding.detail += (finding.detail.empty() ? "" : ", ") + negative;
  }
  if (finding.count == 0) return {};
  auto const torque = options.columns.find("torque");
  finding.column = torque != options.columns.end() ? torque->second : std::string();
  return finding;
}

}  // namespace

std::vector<Finding> arm_findings(Experiment::Parts const& parts, RecordingOptions const& options) {
  std::vector<Finding> findings;
  if (too_few_rows(parts.train.regression)) return findings;
  for (auto& found : {negative_finding(parts, options), influence_finding(parts)})
    if (found) findings.push_back(*found);
  return findings;
}

}  // namespace torquescope
