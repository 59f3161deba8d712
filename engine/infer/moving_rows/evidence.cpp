#include "engine/infer/moving_rows/evidence.hpp"

#include <algorithm>
#include <utility>

#include "engine/base/dense_solvers.hpp"
#include "engine/effects/carry_over.hpp"
#include "engine/fit/statistics/equal_blocks.hpp"
#include "engine/fit/statistics/hat_functions.hpp"
#include "engine/infer/moving_rows/decision_levels.hpp"

namespace torquescope {
namespace {

std::vector<bool> signs(Effect const& effect) {
  std::vector<bool> non_negative(effect.n_linear());
  for (std::size_t k = 0; k < non_negative.size(); ++k)
    non_negative[k] = effect.parameters()[k].sign() == Sign::non_negative;
  return non_negative;
}

// blocks of a recording's rows, as many as training has folds
Eigen::MatrixXd block_sums(Eigen::MatrixXd const& per_row) {
  Eigen::MatrixXd sums(n_folds, per_row.cols());
  auto const blocks = equal_blocks(per_row.rows(), n_folds);
  for (Eigen::Index b = 0; b < n_folds; ++b)
    sums.row(b) =
        per_row.middleRows(blocks[static_cast<std::size_t>(b)].from, blocks[static_cast<std::size_t>(b)].size())
            .colwise()
            .sum();
  return sums;
}

// explains something with linear parameters within what the joint could have
bool is_possible(Effect const& effect, BoundedGain const& found, JointScales const& scales) {
  if (!(found.gain > 0.0)) return false;
  auto const bounds = effect.linear_bounds(scales);
  for (std::size_t k = 0; k < bounds.size(); ++k) {
    double const value = found.parameters[static_cast<Eigen::Index>(k)];
    if (value < bounds[k].lower || value > bounds[k].upper) return false;
  }
  return true;
}

// a law of one parameter that physics gives a sign counts only with that sign
void drop_wrong_signs(OrthonormalGroup const& group, Eigen::MatrixXd const& coefficients, Eigen::MatrixXd& gains) {
  if (group.r.cols() != 1 || group.rank() != 1 || !group.non_negative[0]) return;
  for (Eigen::Index t = 0; t < coefficients.cols(); ++t)
    if (coefficients(0, t) * group.r(0, 0) <= 0.0) gains.col(t).setZero();
}

}  // namespace

Evidence::Evidence(StageSetting const& setting, ModelStage const& stage, OtherRecordings const& others)
    : stage_(&stage), training_(stage, CandidateColumns::none), seed_(setting.seed) {
  std::uint32_t index = 1;
  auto const evidence_of = [&](Recording const& recording) {
    auto one = unseen_evidence(setting, stage, columns(), recording, index++);
    if (!one) without_replicates_.push_back(unseen_residual(setting, stage, recording));
    return one;
  };
  std::vector<UnseenEvidence> further;
  for (auto const& recording : others.training)
    if (auto one = evidence_of(recording)) further.push_back(std::move(*one));
  training_.add(std::move(further), CandidateColumns::none);
  fill_folds();
  for (auto const& recording : others.unseen) {
    auto one = evidence_of(recording);
    weights_unseen_.push_back(one ? one->pipeline->weights() : nullptr);
    if (one) add_unseen(std::move(*one));
  }
}

Evidence::Evidence(Evidence const& of, std::size_t without)
    : stage_(of.stage_), training_(*of.stage_, without), seed_(of.seed_) {
  auto const without_it = [&](UnseenEvidence const& one) {
    return without_effect(one, *stage_, columns(), without, seed_);
  };
  std::vector<UnseenEvidence> further;
  for (auto const& one : of.training_.further()) further.push_back(without_it(one));
  training_.add(std::move(further), without);
  fill_folds();
  for (auto const& one : of.unseen_) add_unseen(without_it(one.evidence));
}

void Evidence::fill_folds() {
  whole_ = in_folds(FoldKind::whole);
  interleaved_ = in_folds(FoldKind::interleaved);
  left_unseen_.resize(0, training_.signals());
}

void Evidence::add_unseen(UnseenEvidence one) {
  one.nuisance = training_.in_basis(one.nuisance);
  Unseen unseen;
  unseen.nuisance_and_left.resize(one.nuisance.rows(), one.nuisance.cols() + one.signals.cols());
  unseen.nuisance_and_left << one.nuisance, one.signals;
  one.signals = {};
  unseen.nuisance_and_left.rightCols(training_.signals()).noalias() -= one.nuisance * whole_.products.whole;
  unseen.evidence = std::move(one);
  Eigen::MatrixXd const products = inner_products(unseen.evidence.nuisance, unseen.nuisance_and_left);
  unseen.nuisance_gram = products.leftCols(unseen.evidence.nuisance.cols());
  unseen.nuisance_left = products.rightCols(training_.signals());
  Eigen::MatrixXd const blocks = block_sums(unseen.left().array().square().matrix());
  left_unseen_.conservativeResize(left_unseen_.rows() + blocks.rows(), Eigen::NoChange);
  left_unseen_.bottomRows(blocks.rows()) = blocks;
  unseen_.push_back(std::move(unseen));
}

Evidence Evidence::with_own_events(std::span<Effect const* const> laws) && {
  for (auto const* event : laws) {
    if (carry_over(*event) != CarryOver::none) continue;
    std::vector<Eigen::MatrixXd> columns;
    for (Unseen const& one : unseen_)
      columns.push_back(own_event_columns(one.evidence, *event, one.left().col(0), seed_));
    // every signal of every recording again: only where there is an event
    if (std::all_of(columns.begin(), columns.end(), [](auto const& of) { return of.cols() == 0; })) continue;
    std::vector<Unseen> own;
    for (std::size_t i = 0; i < unseen_.size(); ++i) own.push_back(less(unseen_[i], columns[i]));
    own_events_[event] = std::move(own);
  }
  return std::move(*this);
}

std::vector<Evidence::Unseen> const& Evidence::unseen_beside(Effect const& effect) const {
  auto const own = own_events_.find(&effect);
  return own == own_events_.end() ? unseen_ : own->second;
}

// columns: nuisances of that recording alone
Evidence::Unseen Evidence::less(Unseen unseen, Eigen::MatrixXd const& columns) const {
  if (columns.cols() == 0) return unseen;
  Eigen::MatrixXd const basis = orthonormal_basis(columns);
  unseen.nuisance_and_left -= basis * (basis.transpose() * unseen.nuisance_and_left).eval();
  Eigen::Index const k = unseen.nuisance_gram.cols();
  Eigen::MatrixXd const products = inner_products(unseen.nuisance_and_left.leftCols(k), unseen.nuisance_and_left);
  unseen.evidence.nuisance = unseen.nuisance_and_left.leftCols(k);
  unseen.nuisance_gram = products.leftCols(k);
  unseen.nuisance_left = products.rightCols(training_.signals());
  return unseen;
}

Evidence::InFolds Evidence::in_folds(FoldKind kind) const {
  Eigen::Index const k = training_.nuisances(), m = training_.signals();
  InFolds result;
  result.folds = training_.folds(kind);
  FoldProducts const all = fold_products(result.folds, training_.basis(), training_.basis_and_signals());
  result.gram = picked(all, 0, k, 0, k);
  result.products = picked(all, 0, k, k, m);
  result.gains = {result.gram, result.products};
  result.left = left_inside_less_own(result.gram, result.products) +
                fold_energies(result.folds, training_.basis_and_signals().rightCols(m));
  return result;
}

double Evidence::torque_energy_unseen() const {
  double energy = 0.0;
  for (auto const& one : unseen_) energy += one.evidence.comparison->rows.torque.squaredNorm();
  return energy;
}

double Evidence::law_energy_unseen() const {
  double energy = 0.0;
  auto const& effects = stage_->model().effects();
  for (auto const& one : unseen_)
    for (std::size_t i = 0; i < effects.size(); ++i)
      if (!is_clock_bound(*effects[i].effect)) energy += torque_of(*stage_, *one.evidence.columns, i).squaredNorm();
  return energy;
}

std::vector<LawGain> Evidence::gains(Effect const& effect, std::vector<std::vector<double>> const& shapes,
                                     FoldKind kind, DrivenBy motion, LawRate rate) const {
  InFolds const& beside = folds_of(kind);
  auto const each = training_.columns_of_each(effect, shapes, motion, rate);
  std::vector<OrthonormalGroup> groups;
  Eigen::Index width = 0;
  for (auto const& one : each) {
    groups.push_back(orthonormal_group(one, training_.basis(), signs(effect)));
    width += groups.back().rank();
  }
  Eigen::MatrixXd q(training_.basis().rows(), width);
  Eigen::Index at = 0;
  for (auto const& group : groups) {
    q.middleCols(at, group.rank()) = group.q;
    at += group.rank();
  }
  FoldProducts const all = fold_products(beside.folds, q, training_.basis_and_signals());
  std::vector<FoldProducts> own;
  for (auto const& group : groups) own.push_back(fold_products(beside.folds, group.q, group.q));
  std::vector<Eigen::MatrixXd> in_folds = beside.gains.of_each(all, own);
  std::vector<Candidate> candidates;
  std::vector<LawGain> results;
  at = 0;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    Eigen::Index const rank = groups[i].rank();
    candidates.push_back(
        {&effect, &groups[i], &each[i], all.whole.block(at, training_.nuisances(), rank, training_.signals())});
    if (rank > 0) candidates.back().bounded = bounded_gain(groups[i], candidates.back().coefficients.col(0));
    results.push_back(gain_in_training(candidates.back(), std::move(in_folds[i])));
    at += rank;
  }
  for (Unseen const& there : unseen_beside(effect))
    add_unseen(candidates, columns_unseen(effect, shapes, rate, there.evidence), there, results);
  // nothing with the signs that physics allows; replicates are not asked for theirs, which is on the safe side
  for (std::size_t i = 0; i < results.size(); ++i)
    if (results[i].is_testable && !is_possible(effect, candidates[i].bounded, columns().scales()))
      results[i].train[0] = results[i].first[0] = results[i].unseen[0] = 0.0;
  return results;
}

LawGain Evidence::gain_in_training(Candidate const& candidate, Eigen::MatrixXd in_folds) const {
  OrthonormalGroup const& group = *candidate.group;
  LawGain result;
  result.train = result.first = result.unseen = Eigen::VectorXd::Zero(training_.signals());
  if (group.rank() == 0) return result;
  result.is_testable = true;
  result.parameters = candidate.bounded.parameters;
  drop_wrong_signs(group, candidate.coefficients, in_folds);
  result.train = in_folds.colwise().sum().transpose();
  result.first = in_folds.topRows(n_folds).colwise().sum().transpose();
  return result;
}

std::vector<Eigen::MatrixXd> Evidence::columns_unseen(Effect const& effect,
                                                      std::vector<std::vector<double>> const& shapes, LawRate rate,
                                                      UnseenEvidence const& there) {
  if (CarryOver const over = carry_over(effect); over == CarryOver::none || over == CarryOver::in_frequency) {
    auto const width = static_cast<Eigen::Index>(effect.n_linear());
    return std::vector<Eigen::MatrixXd>(shapes.size(), Eigen::MatrixXd::Zero(there.nuisance.rows(), width));
  }
  auto laws = there.columns->columns_of_each(effect, shapes, rate);
  for (auto& law : laws) law = there.without_own(std::move(law));
  return laws;
}

Evidence::UnseenStep Evidence::step_unseen(Candidate const& candidate, Eigen::MatrixXd const& law) const {
  OrthonormalGroup const& group = *candidate.group;
  // coefficients of the orthonormal columns are combinations of parameters: r parameters = coefficients
  Eigen::MatrixXd const to_parameters =
      group.r.transpose() * solve_semidefinite(group.r * group.r.transpose(),
                                               Eigen::MatrixXd(Eigen::MatrixXd::Identity(group.rank(), group.rank())));
  return {inner_products(training_.basis(), *candidate.columns) * to_parameters, law * to_parameters,
          carry_over(*candidate.effect) == CarryOver::in_part};
}

Evidence::UnseenProducts::UnseenProducts(UnseenStep const& step, Unseen const& unseen,
                                         Eigen::Ref<Eigen::MatrixXd const> const& law) {
  Eigen::Index const k = step.nuisance.rows(), signals = law.cols() - k;
  model_left = -step.nuisance.transpose() * unseen.nuisance_left.leftCols(signals);
  law_left = law.rightCols(signals);
  model_model = step.nuisance.transpose() * unseen.nuisance_gram * step.nuisance;
  law_model = -law.leftCols(k) * step.nuisance;
  law_law = inner_products(step.law, step.law);
}

// of each signal, what fits it best
Eigen::RowVectorXd Evidence::UnseenProducts::shares(Eigen::MatrixXd const& coefficients) const {
  Eigen::RowVectorXd const wanted =
      (coefficients.array() * (law_left - law_model * coefficients).array()).colwise().sum();
  Eigen::RowVectorXd const whole = (coefficients.array() * (law_law * coefficients).array()).colwise().sum();
  return wanted.binaryExpr(whole, [](double a, double b) { return b > 0.0 ? std::clamp(a / b, 0.0, 1.0) : 0.0; });
}

void Evidence::add_unseen(std::vector<Candidate> const& candidates, std::vector<Eigen::MatrixXd> const& laws,
                          Unseen const& there, std::vector<LawGain>& gains) const {
  std::vector<UnseenStep> steps(candidates.size());
  std::vector<Eigen::MatrixXd> each;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (!gains[i].is_testable) continue;
    steps[i] = step_unseen(candidates[i], laws[i]);
    each.push_back(steps[i].law);
  }
  if (each.empty()) return;
  // of all at once: the signals are many, and are read once
  Eigen::MatrixXd const products = inner_products(side_by_side(each), there.nuisance_and_left);
  Eigen::Index at = 0;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (!gains[i].is_testable) continue;
    Eigen::MatrixXd const& of_signals = candidates[i].coefficients;
    UnseenProducts const of(steps[i], there, products.middleRows(at, of_signals.rows()));
    at += of_signals.rows();
    Eigen::MatrixXd const own =
        steps[i].by_share ? Eigen::MatrixXd(of_signals * of.shares(of_signals).asDiagonal()) : of_signals;
    auto const by_model = of_signals.array() * (2.0 * of.model_left - of.model_model * of_signals).array();
    auto const by_law = own.array() * (2.0 * (of.law_left - of.law_model * of_signals) - of.law_law * own).array();
    Eigen::MatrixXd fall = (by_model + by_law).colwise().sum();
    drop_wrong_signs(*candidates[i].group, of_signals, fall);
    gains[i].unseen += fall.transpose();
  }
}

std::vector<RowsLeft::Part> Evidence::of_recordings(Eigen::VectorXd const& left) const {
  std::vector<RowsLeft::Part> parts;
  for (auto const& one : training_.recordings())
    parts.push_back({left.segment(one.rows.from, one.rows.size()), one.memory_rows});
  return parts;
}

RowsLeft Evidence::rows_left(FoldKind kind) const {
  InFolds const& beside = folds_of(kind);
  Eigen::Index const k = training_.nuisances();
  RowsLeft left{of_recordings(left_on_rows(beside.folds, training_.basis(), training_.basis_and_signals().col(k),
                                           beside.gram, picked(beside.products, 0, k, 0, 1)))};
  for (Unseen const& one : unseen_) left.parts.push_back({one.left().col(0), one.evidence.memory_rows});
  return left;
}

RowsLeft Evidence::rows_left(Effect const& effect, std::vector<std::vector<double>> const& shapes, FoldKind kind,
                             DrivenBy motion) const {
  InFolds const& beside = folds_of(kind);
  Eigen::MatrixXd const& basis = training_.basis();
  Eigen::MatrixXd const law = side_by_side(training_.columns_of_each(effect, shapes, motion));
  std::vector<bool> of_each;
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    std::vector<bool> const own = signs(effect);
    of_each.insert(of_each.end(), own.begin(), own.end());
  }
  OrthonormalGroup const group = orthonormal_group(law, basis, of_each);
  Eigen::Index const k = training_.nuisances();
  FoldProducts const all = fold_products(beside.folds, group.q, training_.basis_and_signals().leftCols(k + 1)),
                     cross = picked(all, 0, group.rank(), 0, k), products = picked(all, 0, group.rank(), k, 1);
  FoldProducts const gram = gram_of(beside.gram, cross, fold_products(beside.folds, group.q, group.q));
  Eigen::MatrixXd both(group.q.rows(), k + group.rank());
  both << basis, group.q;
  RowsLeft left{of_recordings(left_on_rows(beside.folds, both, training_.basis_and_signals().col(k), gram,
                                           stacked(picked(beside.products, 0, k, 0, 1), products)))};
  Candidate const candidate{&effect, &group, &law, products.whole};
  for (Unseen const& one : unseen_beside(effect)) {
    UnseenStep const step =
        step_unseen(candidate, side_by_side(columns_unseen(effect, shapes, LawRate::full, one.evidence)));
    Eigen::VectorXd of_law = step.law * products.whole;
    if (step.by_share) {
      UnseenProducts const of(step, one, inner_products(step.law, one.nuisance_and_left.leftCols(k + 1)));
      of_law *= of.shares(products.whole)[0];
    }
    left.parts.push_back({one.left().col(0) + one.evidence.nuisance * (step.nuisance * products.whole) - of_law,
                          one.evidence.memory_rows});
  }
  return left;
}

}  // namespace torquescope
