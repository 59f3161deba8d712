#include "engine/infer/moving_rows/training_rows.hpp"

#include <utility>

#include "engine/base/dense_solvers.hpp"
#include "engine/effects/carry_over.hpp"
#include "engine/fit/statistics/bounded_projection.hpp"
#include "engine/infer/moving_rows/decision_levels.hpp"
#include "engine/infer/moving_rows/law_forms.hpp"

namespace torquescope {
namespace {

Eigen::VectorXd energies(Eigen::MatrixXd const& columns) { return columns.colwise().squaredNorm().transpose(); }

// other forms of the model's laws on a further recording, beside all that its own fit explains; orthonormal
Eigen::MatrixXd forms_on(ModelStage const& stage, UnseenEvidence const& one, std::size_t without) {
  Eigen::MatrixXd const signals = forms_of_laws(stage, one.pipeline->model(), one.comparison->common, without);
  if (signals.cols() == 0) return Eigen::MatrixXd(one.signals.rows(), 0);
  Eigen::MatrixXd columns = one.pipeline->filtered_columns(signals, one.comparison->common);
  one.pipeline->whiten(columns, one.comparison->rows.kept_rows);
  std::vector<bool> const any_sign(static_cast<std::size_t>(columns.cols()), false);
  return orthonormal_group(std::move(columns), one.columns->nuisance(), any_sign).q;
}

}  // namespace

TrainingRows::TrainingRows(ModelStage const& stage, std::size_t without) : stage_(&stage), motions_(stage, without) {
  auto const& rows = stage.comparison.rows;
  Eigen::MatrixXd signals = exchangeable(rows.residual, rows.twins);
  signals.col(0) += torque_of(stage, columns(), without);
  Eigen::VectorXd const by_model = energies(columns().nuisance().transpose() * signals);
  Eigen::MatrixXd const forms = forms_of_laws(stage, stage.model(), stage.comparison.common, without);
  if (forms.cols() > 0) motions_.twin.add_nuisance(forms);
  basis_ = columns().nuisance();
  by_forms_ = energies(basis_.transpose() * signals) - by_model;
  basis_and_signals_.resize(rows.size(), basis_.cols() + signals.cols());
  basis_and_signals_ << basis_, signals;
  recordings_.push_back({{0, rows.size()}, guard_rows(*stage.pipeline)});
}

void TrainingRows::add(std::vector<UnseenEvidence> further, std::size_t without) {
  if (further.empty()) return;
  further_ = std::move(further);
  std::vector<Eigen::MatrixXd> forms;
  for (auto const& one : further_) {
    forms.push_back(forms_on(*stage_, one, without));
    by_forms_ += energies(forms.back().transpose() * one.signals);
    RowBlock const before = recordings_.back().rows;
    recordings_.push_back({{before.to, before.to + one.signals.rows()}, one.memory_rows});
  }
  stack(forms);
}

// The first's columns are orthonormal there, and a form is orthonormal beside them on its own recording: the stack
// S = (B; N_2; ...) has full rank, and S L^-T is orthonormal for S'S = L L'
void TrainingRows::stack(std::vector<Eigen::MatrixXd> const& forms) {
  Eigen::Index const first_k = basis_.cols(), n_signals = signals(), n = recordings_.back().rows.to;
  Eigen::Index k = first_k;
  for (auto const& own : forms) k += own.cols();
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(n, k + n_signals);
  all.topLeftCorner(basis_.rows(), first_k) = basis_;
  all.topRightCorner(basis_.rows(), n_signals) = basis_and_signals_.rightCols(n_signals);
  Eigen::MatrixXd gram = Eigen::MatrixXd::Identity(first_k, first_k);
  Eigen::Index at = first_k;
  for (std::size_t i = 0; i < further_.size(); ++i) {
    RowBlock const rows = recordings_[i + 1].rows;
    gram.noalias() += further_[i].nuisance.transpose() * further_[i].nuisance;
    all.block(rows.from, 0, rows.size(), first_k) = further_[i].nuisance;
    all.block(rows.from, at, rows.size(), forms[i].cols()) = forms[i];
    all.block(rows.from, k, rows.size(), n_signals) = further_[i].signals;
    at += forms[i].cols();
  }
  auto const factor = cholesky_of(gram);
  TORQUESCOPE_ENSURE(factor.has_value());
  to_basis_ = Eigen::MatrixXd::Zero(first_k, k);
  to_basis_.leftCols(first_k) = factor->solve_upper(Eigen::MatrixXd::Identity(first_k, first_k));
  all.leftCols(first_k) = (all.leftCols(first_k) * to_basis_.leftCols(first_k)).eval();
  basis_ = all.leftCols(k);
  basis_and_signals_ = std::move(all);
  for (auto& one : further_) one.signals = {};
}

Eigen::MatrixXd TrainingRows::in_basis(Eigen::MatrixXd const& nuisance) const {
  return to_basis_.size() > 0 ? Eigen::MatrixXd(nuisance * to_basis_) : nuisance;
}

std::vector<Eigen::MatrixXd> TrainingRows::columns_of_each(Effect const& effect,
                                                           std::vector<std::vector<double>> const& shapes,
                                                           DrivenBy motion, LawRate rate) const {
  std::vector<Eigen::MatrixXd> each = columns(motion).columns_of_each(effect, shapes, rate);
  if (further_.empty()) return each;
  for (auto& law : each) {
    Eigen::Index const first = law.rows();
    law.conservativeResize(basis_.rows(), Eigen::NoChange);
    law.bottomRows(basis_.rows() - first).setZero();
  }
  if (is_clock_bound(effect)) return each;
  for (std::size_t i = 0; i < further_.size(); ++i) {
    auto const here = further_[i].columns->columns_of_each(effect, shapes, rate);
    RowBlock const rows = recordings_[i + 1].rows;
    for (std::size_t k = 0; k < each.size(); ++k)
      each[k].middleRows(rows.from, rows.size()) = further_[i].without_own(here[k]);
  }
  return each;
}

std::vector<Fold> TrainingRows::folds(FoldKind kind) const {
  std::vector<Fold> all;
  for (Recording const& one : recordings_)
    for (Fold fold : torquescope::folds(one.rows.size(), one.memory_rows, kind)) {
      for (auto* blocks : {&fold.inside, &fold.guard})
        for (RowBlock& block : *blocks) block = {block.from + one.rows.from, block.to + one.rows.from};
      all.push_back(std::move(fold));
    }
  return all;
}

double TrainingRows::law_energy(std::size_t i) const {
  double energy = torque_of(*stage_, columns(), i).squaredNorm();
  if (!is_clock_bound(*stage_->model().effects()[i].effect))
    for (auto const& one : further_) energy += torque_of(*stage_, *one.columns, i).squaredNorm();
  return energy;
}

double TrainingRows::torque_energy() const {
  double energy = stage_->comparison.rows.torque.squaredNorm();
  for (auto const& one : further_) energy += one.comparison->rows.torque.squaredNorm();
  return energy;
}

}  // namespace torquescope
