#include "engine/diagnose/arms/rigid_rows.hpp"

#include <algorithm>
#include <memory>

#include "engine/data/filter_checks.hpp"
#include "engine/diagnose/arms/arm_laws.hpp"
#include "engine/fit/problem/arm_regression.hpp"
#include "engine/fit/problem/covariance_root.hpp"
#include "engine/fit/problem/filtered_grams.hpp"
#include "engine/fit/problem/plain_least_squares.hpp"
#include "engine/fit/problem/recorded_rows.hpp"
#include "engine/fit/problem/regressor_health.hpp"
#include "engine/fit/problem/shortest_fit.hpp"
#include "engine/infer/pipeline/held_torque.hpp"
#include "engine/infer/pipeline/reversal_mask.hpp"
#include "engine/robot/forward_dynamics.hpp"

namespace torquescope {
namespace {

// [N] means of M_jj over instants spread evenly over the recordings
Eigen::VectorXd mean_inertias(ArmModel const& model, Eigen::VectorXd const& parameters,
                              std::span<RecordedArm const> recordings) {
  constexpr Eigen::Index instants = 200;  // of each: a mean needs no more
  auto const joints = static_cast<Eigen::Index>(model.joints());
  Eigen::VectorXd const standard = model.base().to_standard(parameters.head(model.base().size()));
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(joints), q(joints);
  double count = 0.0;
  for (auto const& recording : recordings) {
    auto const& arm = recording.joints;
    Eigen::Index const n = arm.front().position.size(), step = std::max<Eigen::Index>(1, n / instants);
    for (Eigen::Index i = 0; i < n; i += step, count += 1.0) {
      for (Eigen::Index j = 0; j < joints; ++j) q[j] = arm[static_cast<std::size_t>(j)].position[i];
      sum += mass_matrix(model.chain(), standard, q).diagonal();
    }
  }
  return sum / count;
}

// n x c of a joint: its columns times parameters [R][c], without friction
Eigen::MatrixXd rigid_torque(ArmModel const& model, Eigen::MatrixXd const& parameters, std::size_t joint,
                             Eigen::MatrixXd const& rows) {
  auto const& own = model.parameters_of(joint);
  auto const friction = static_cast<Eigen::Index>(model.friction_alone(joint));
  Eigen::MatrixXd of_joint = parameters(own, Eigen::all);
  auto const rigid = std::lower_bound(own.begin(), own.end(), model.base().size()) - own.begin();
  of_joint.middleRows(rigid, friction).setZero();
  return rows * of_joint;
}

std::vector<RigidCorrections> corrections_of(ArmModel const& model, FittedArm const& fitted,
                                             std::span<RecordedArm const> recordings,
                                             std::vector<FilteredGram> const& grams, ArmFilter const& filter) {
  std::vector<CorrectionSums> sums(model.joints());
  for (auto const& recording : recordings) {
    auto const motion = motion_of(recording, filter);
    auto const rows = model.rows(motion, recording.payload);
    for (std::size_t j = 0; j < sums.size(); ++j)
      sums[j].add(motion[j], rigid_torque(model, fitted.white_errors, j, rows[j]));
  }
  std::vector<RigidCorrections> corrections;
  for (std::size_t j = 0; j < sums.size(); ++j)
    corrections.push_back(sums[j].corrections(fitted.noise[static_cast<Eigen::Index>(j)], grams[j].rows));
  return corrections;
}

// of the rows of all recordings; `whole` where they tell all parameters apart
struct RowFit {
  std::vector<FilteredGram> grams{};
  std::optional<RegressionData> whole{};
  Eigen::VectorXd noise{};
};

RowFit rows_to_fit(ArmModel const& model, std::span<RecordedArm const> recordings, ArmFilter const& filter,
                   std::optional<Eigen::VectorXd> const& deviation) {
  std::vector<RecordedRows> rows;
  for (auto const& recording : recordings)
    rows.push_back(rows_of(model, recording, motion_of(recording, filter), filter));
  RowFit fit;
  fit.grams = filtered_grams(rows, model);
  fit.noise = deviation ? *deviation : noise_levels(fit.grams, static_cast<Eigen::Index>(model.size())).deviation;
  RegressionData stacked = stack_rows(rows, ArmRowChoice::moving, model, fit.noise, filter.section);
  // a joint that stands still leaves parameters that nothing tells: the others are searched all the same
  if (!too_few_rows(stacked) && regressor_health(stacked).identifiable) fit.whole = std::move(stacked);
  return fit;
}

Eigen::VectorXd shortest(ArmModel const& model, RowFit const& fit) {
  return shortest_fit(fit.grams, static_cast<Eigen::Index>(model.size()), fit.noise);
}

}  // namespace

FittedArm fit_arm(ArmModel const& model, std::span<RecordedArm const> recordings, ArmFilter const& filter) {
  RowFit const rows = rows_to_fit(model, recordings, filter, {});
  auto const n_parameters = static_cast<Eigen::Index>(model.size());
  FittedArm fitted;
  fitted.noise = rows.noise;
  if (rows.whole) {
    constexpr std::int64_t automatic_lags = -1;
    LeastSquaresFit const fit = plain_least_squares(*rows.whole, automatic_lags);
    fitted.parameters = fit.parameters;
    fitted.errors = covariance_root(fit.covariance_hac);
    fitted.white_errors = covariance_root(fit.covariance_naive);
  } else {
    fitted.parameters = shortest(model, rows);
    fitted.errors.resize(n_parameters, 0);
    fitted.white_errors.resize(n_parameters, 0);
  }
  fitted.inertia = mean_inertias(model, fitted.parameters, recordings);
  fitted.corrections = corrections_of(model, fitted, recordings, rows.grams, filter);
  return fitted;
}

PlainArmFit fit_parameters(ArmModel const& model, std::span<RecordedArm const> recordings, ArmFilter const& filter,
                           std::optional<Eigen::VectorXd> const& deviation) {
  RowFit const rows = rows_to_fit(model, recordings, filter, deviation);
  PlainArmFit fit;
  fit.noise = rows.noise;
  fit.parameters = rows.whole ? solve_weighted(*rows.whole, {}) : shortest(model, rows);
  for (auto const& gram : rows.grams)
    fit.energies.push_back({gram.torque_energy(), gram.residual_energy(fit.parameters)});
  return fit;
}

std::vector<Eigen::VectorXd> needed_torques(ArmModel const& model, Eigen::VectorXd const& parameters,
                                            RecordedArm const& recording, ArmFilter const& filter) {
  auto const rows = model.rows(motion_of(recording, filter), recording.payload);
  std::vector<Eigen::VectorXd> torques;
  for (std::size_t j = 0; j < rows.size(); ++j) {
    torques.emplace_back(rows[j] * parameters(model.parameters_of(j)));
    if (recording.payload) torques.back() += model.known_torque(j, rows[j], *recording.payload);
  }
  return torques;
}

Eigen::Index rows_one_way(Recording const& joint, ArmFilter const& filter) {
  Motion const motion = differentiate(joint, filter.options, filter.section);
  auto const moves = moving_samples(motion.dq, motion.rate_hz, parallel_cutoff_of(filter.options));
  Eigen::VectorXd counted(motion.dq.size());
  for (Eigen::Index i = 0; i < counted.size(); ++i) counted[i] = moves[static_cast<std::size_t>(i)] ? 1.0 : 0.0;
  ParallelFilter const parallel(filter.options, motion.rate_hz, counted.size(), filter.section);
  return static_cast<Eigen::Index>(parallel.pick(counted).sum());
}

std::vector<Recording> joints_alone(ArmModel const& model, FittedArm const& fitted, RecordedArm const& recording,
                                    ArmFilter const& filter) {
  auto const motion = motion_of(recording, filter);
  auto const rows = model.rows(motion, recording.payload);
  std::vector<Recording> alone = recording.joints;
  auto laws = arm_law_signals(model, motion);
  for (std::size_t j = 0; j < alone.size(); ++j) {
    Eigen::VectorXd beside = rigid_torque(model, fitted.parameters, j, rows[j]);
    if (recording.payload) beside += model.known_torque(j, rows[j], *recording.payload);
    beside -= fitted.inertia[static_cast<Eigen::Index>(j)] * motion[j].ddq;
    alone[j].torque -= torque_to_hold(beside);
    // of an arm with a simulator, what that knows beyond the model passes the gear as well
    if (alone[j].gear_load.size() > 0) beside += alone[j].gear_load;
    alone[j].gear_load = std::move(beside);
    constexpr double matters = 0.1;  // of the noise: what is less adds half a per cent to it
    alone[j].load_errors = largest_parts(rigid_torque(model, fitted.errors, j, rows[j]),
                                         matters * fitted.noise[static_cast<Eigen::Index>(j)]);
    if (RigidCorrections const& free = fitted.corrections[j]; free.size() > 0)
      laws[j].laws.push_back(
          {corrections_name,
           correction_columns(free, motion[j], rigid_torque(model, fitted.white_errors, j, rows[j]))});
    alone[j].given = std::make_shared<GivenSignals const>(std::move(laws[j]));
  }
  return alone;
}

}  // namespace torquescope
