#include "engine/infer/decision/pooled_rows.hpp"

#include <cmath>

#include "engine/base/contract.hpp"
#include "engine/fit/statistics/equal_blocks.hpp"
#include "engine/fit/statistics/scaled_solution.hpp"

namespace torquescope {
namespace {

// columns of the model but for those of one given term
std::vector<Eigen::Index> without_term(Regressor const& regressor, std::string const& term, Eigen::Index columns) {
  std::vector<Eigen::Index> kept;
  auto const& owners = regressor.column_owners();
  for (Eigen::Index k = 0; k < columns; ++k) {
    auto const at = static_cast<std::size_t>(k);
    if (at >= owners.size() || regressor.terms()[owners[at].term]->name() != term) kept.push_back(k);
  }
  return kept;
}

Eigen::MatrixXd shared_on_rows(Strip const& strip, SampleTreatment const& samples, SharedEffect const& effect) {
  Eigen::MatrixXd const* const columns = strip.beside.given ? strip.beside.given->of(effect.shared) : nullptr;
  TORQUESCOPE_EXPECT(columns != nullptr && columns->cols() == std::ssize(effect.places));
  Eigen::MatrixXd const rows = on_rows(strip, samples.weight.asDiagonal() * *columns);
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(rows.rows(), effect.parameters);
  all(Eigen::all, effect.places) = rows;
  return all;
}

Eigen::MatrixXd shared_on_rows(FittedStrips const& fitted, SharedEffect const& effect) {
  Eigen::MatrixXd all(fitted.on().rows(), effect.parameters);
  Eigen::Index row = 0;
  for (std::size_t i = 0; i < fitted.strips().size(); ++i) {
    Eigen::MatrixXd const rows = shared_on_rows(fitted.strips()[i], fitted.chosen().fit.samples[i], effect);
    all.middleRows(row, rows.rows()) = rows;
    row += rows.rows();
  }
  return all;
}

SharedRows rows_of(FittedStrips const& fitted, Eigen::MatrixXd const& columns, SharedEffect const& effect) {
  auto const own = without_term(fitted.on().model().regressor(), effect.instead_of, columns.cols());
  return {shared_on_rows(fitted, effect), columns(Eigen::all, own), fitted.chosen().fit.torque};
}

// less the mean that a constant may take
SharedRows less_mean(SharedRows rows, Eigen::VectorXd const& constant) {
  double const whole = constant.squaredNorm();
  if (!(whole > 0.0)) return rows;
  auto const take = [&](auto& columns) {
    columns = (columns - constant * (constant.transpose() * columns) / whole).eval();
  };
  take(rows.shared);
  take(rows.own);
  take(rows.torque);
  return rows;
}

SharedRows picked(SharedRows const& rows, std::vector<Eigen::Index> const& which) {
  return {rows.shared(which, Eigen::all), rows.own(which, Eigen::all), rows.torque(which)};
}

// squares that the fit with these shared parameters, and own ones from `trained`, leaves of `rows`
double left_of(SharedRows const& rows, SharedRows const& trained, Eigen::VectorXd const& shared) {
  Eigen::VectorXd const own = solve_scaled(trained.own, trained.torque - trained.shared * shared).col(0);
  // further recordings' offsets stand behind what other recordings have as well
  return (rows.torque - rows.shared * shared - rows.own * own.head(rows.own.cols())).squaredNorm();
}

Eigen::VectorXd fitted_together(std::vector<SharedRows> const& joints, std::vector<double> const& variances) {
  SharedInformation all = SharedInformation::none(joints.front().shared.cols());
  for (std::size_t j = 0; j < joints.size(); ++j) all.add(information_of(joints[j], variances[j]));
  return shared_parameters(all);
}

Eigen::VectorXd held_out_squares(std::span<PooledRows const* const> joints, std::vector<double> const& variances) {
  Eigen::VectorXd left = Eigen::VectorXd::Zero(std::ssize(joints));
  for (Eigen::Index fold = 0; fold < n_folds; ++fold) {
    std::vector<SharedRows> inside, outside;
    for (auto const* joint : joints) {
      Eigen::Index const n = joint->training.torque.size();
      RowBlock const block = equal_blocks(n, n_folds)[static_cast<std::size_t>(fold)];
      std::vector<Eigen::Index> held;
      for (Eigen::Index i = block.from; i < block.to; ++i) held.push_back(i);
      inside.push_back(picked(joint->training, held));
      outside.push_back(picked(joint->training, rows_outside(n, block, joint->guard)));
    }
    Eigen::VectorXd const shared = fitted_together(outside, variances);
    for (std::size_t j = 0; j < joints.size(); ++j)
      left[static_cast<Eigen::Index>(j)] += left_of(inside[j], outside[j], shared);
  }
  return left;
}

}  // namespace

SharedRows shared_rows(FittedStrips const& fitted, SharedEffect const& effect) {
  return rows_of(fitted, fitted.base(), effect);
}

OtherRows predicted_rows(FittedModel const& by, Strip const& strip, SharedEffect const& effect) {
  ModelOnStrips const on(*by.model, {&strip, 1});
  Eigen::VectorXd const parameters = by.fitted->parameters().head(on.parameters());
  double const late_s = by.fitted->chosen().late_s;
  auto const samples = treated_samples(on, late_s, parameters, by.fitted->chosen().fit.sticking);
  Eigen::MatrixXd const columns = model_on_rows(on, samples);
  auto const own = without_term(by.model->regressor(), effect.instead_of, columns.cols());
  return {
      {shared_on_rows(strip, samples.front(), effect), columns(Eigen::all, own), torque_on_rows(on, samples, late_s)},
      on_rows(strip, samples.front().weight).col(0)};
}

PooledRows pooled_rows(JointStrips const& rows, FittedModel const& by, SharedEffect const& effect) {
  PooledRows pooled;
  pooled.training = rows_of(*by.fitted, by.fitted->chosen().fit.columns, effect);
  for (auto const& strip : rows.validation) {
    OtherRows const other = predicted_rows(by, strip, effect);
    pooled.validation.push_back(less_mean(other.rows, other.constant));
  }
  pooled.guard = by.fitted->guard();
  pooled.training_energy = rows.training_energy;
  pooled.validation_energy = rows.validation_energy;
  return pooled;
}

PooledErrors pooled_errors(std::span<PooledRows const* const> joints, std::vector<double> const& variances) {
  std::vector<SharedRows> training;
  for (auto const* joint : joints) training.push_back(joint->training);
  Eigen::VectorXd const shared = fitted_together(training, variances), held_out = held_out_squares(joints, variances);
  PooledErrors errors;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    PooledRows const& joint = *joints[j];
    auto const at = static_cast<Eigen::Index>(j);
    double validation = 0.0;
    for (auto const& strip : joint.validation) validation += left_of(strip, joint.training, shared);
    ModelErrors own{std::sqrt(left_of(joint.training, joint.training, shared) / joint.training_energy),
                    std::sqrt(held_out[at] / joint.training_energy)};
    if (!joint.validation.empty()) own.validation = std::sqrt(validation / joint.validation_energy);
    errors.of_joints.push_back(own);
    errors.judged += (joint.validation.empty() ? held_out[at] : validation) / variances[j];
  }
  return errors;
}

}  // namespace torquescope
