#include "engine/inference/evidence.hpp"

#include <algorithm>
#include <utility>

#include "engine/base/dense_solvers.hpp"
#include "engine/effects/carry_over.hpp"
#include "engine/inference/decision_levels.hpp"
#include "engine/statistics/equal_blocks.hpp"

namespace torquescope {
namespace {

std::vector<bool> signs(Effect const& effect) {
  std::vector<bool> non_negative(effect.n_linear());
  for (std::size_t k = 0; k < non_negative.size(); ++k)
    non_negative[k] = effect.parameters()[k].sign() == Sign::non_negative;
  return non_negative;
}

Eigen::MatrixXd side_by_side(std::vector<Eigen::MatrixXd> const& each) {
  if (each.size() == 1) return each.front();
  Eigen::MatrixXd all(each.front().rows(), each.front().cols() * static_cast<Eigen::Index>(each.size()));
  for (std::size_t i = 0; i < each.size(); ++i)
    all.middleCols(static_cast<Eigen::Index>(i) * each[i].cols(), each[i].cols()) = each[i];
  return all;
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

// linear parameters within what the joint could have
bool are_plausible(Effect const& effect, Eigen::VectorXd const& parameters, JointScales const& scales) {
  auto const bounds = effect.linear_bounds(scales);
  for (std::size_t k = 0; k < bounds.size(); ++k) {
    double const value = parameters[static_cast<Eigen::Index>(k)];
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
    : stage_(&stage), training_(stage, CandidateColumns::none) {
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

Evidence::Evidence(Evidence const& of, std::size_t without) : stage_(of.stage_), training_(*of.stage_, without) {
  auto const without_it = [&](UnseenEvidence const& one) { return without_effect(one, *stage_, columns(), without); };
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
  std::vector<LawGain> results;
  at = 0;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    Eigen::Index const rank = groups[i].rank();
    results.push_back(gain_of({&effect, std::span(shapes).subspan(i, 1), &groups[i], &each[i],
                               all.whole.block(at, training_.nuisances(), rank, training_.signals()), rate},
                              std::move(in_folds[i])));
    at += rank;
  }
  return results;
}

LawGain Evidence::gain_of(Candidate const& candidate, Eigen::MatrixXd in_folds) const {
  OrthonormalGroup const& group = *candidate.group;
  LawGain result;
  result.train = result.first = result.unseen = Eigen::VectorXd::Zero(training_.signals());
  if (group.rank() == 0) return result;
  result.is_testable = true;
  BoundedGain const bounded = bounded_gain(group, candidate.coefficients.col(0));
  result.parameters = bounded.parameters;
  drop_wrong_signs(group, candidate.coefficients, in_folds);
  result.train = in_folds.colwise().sum().transpose();
  result.first = in_folds.topRows(n_folds).colwise().sum().transpose();
  add_unseen(candidate, result);
  // nothing with the signs that physics allows; replicates are not asked for theirs, which is on the safe side
  if (!(bounded.gain > 0.0) || !are_plausible(*candidate.effect, bounded.parameters, columns().scales()))
    result.train[0] = result.first[0] = result.unseen[0] = 0.0;
  return result;
}

Evidence::UnseenStep Evidence::step_unseen(Candidate const& candidate, UnseenEvidence const& one) const {
  OrthonormalGroup const& group = *candidate.group;
  // coefficients of the orthonormal columns are combinations of parameters: r parameters = coefficients
  Eigen::MatrixXd const to_parameters =
      group.r.transpose() * solve_semidefinite(group.r * group.r.transpose(),
                                               Eigen::MatrixXd(Eigen::MatrixXd::Identity(group.rank(), group.rank())));
  CarryOver const over = carry_over(*candidate.effect);
  UnseenStep step;
  step.by_share = over == CarryOver::in_part;
  step.nuisance = inner_products(training_.basis(), *candidate.columns) * to_parameters;
  if (over == CarryOver::none)
    step.law = Eigen::MatrixXd::Zero(one.nuisance.rows(), to_parameters.cols());
  else
    step.law = one.without_own(side_by_side(one.columns->columns_of_each(
                   *candidate.effect, std::vector(candidate.shapes.begin(), candidate.shapes.end()), candidate.rate))) *
               to_parameters;
  return step;
}

Evidence::UnseenProducts::UnseenProducts(UnseenStep const& step, Unseen const& unseen, Eigen::Index signals) {
  Eigen::Index const k = step.nuisance.rows();
  Eigen::MatrixXd const law = inner_products(step.law, unseen.nuisance_and_left);  // r x (k + 1 + M)
  model_left = -step.nuisance.transpose() * unseen.nuisance_left.leftCols(signals);
  law_left = law.middleCols(k, signals);
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

void Evidence::add_unseen(Candidate const& candidate, LawGain& gain) const {
  Eigen::MatrixXd const& steps = candidate.coefficients;
  for (Unseen const& one : unseen_) {
    UnseenStep const step = step_unseen(candidate, one.evidence);
    UnseenProducts const of(step, one, steps.cols());
    Eigen::MatrixXd const own = step.by_share ? Eigen::MatrixXd(steps * of.shares(steps).asDiagonal()) : steps;
    auto const by_model = steps.array() * (2.0 * of.model_left - of.model_model * steps).array();
    auto const by_law = own.array() * (2.0 * (of.law_left - of.law_model * steps) - of.law_law * own).array();
    Eigen::MatrixXd gains = (by_model + by_law).colwise().sum();
    drop_wrong_signs(*candidate.group, steps, gains);
    gain.unseen += gains.transpose();
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
  Candidate const candidate{&effect, shapes, &group, &law, products.whole};
  for (Unseen const& one : unseen_) {
    UnseenStep const step = step_unseen(candidate, one.evidence);
    Eigen::VectorXd of_law = step.law * products.whole;
    if (step.by_share) of_law *= UnseenProducts(step, one, 1).shares(products.whole)[0];
    left.parts.push_back({one.left().col(0) + one.evidence.nuisance * (step.nuisance * products.whole) - of_law,
                          one.evidence.memory_rows});
  }
  return left;
}

namespace {

std::vector<HeldOutBlock> paired_blocks(RowsLeft const& before, RowsLeft const& after) {
  std::vector<HeldOutBlock> paired;
  for (std::size_t i = 0; i < before.parts.size(); ++i) {
    auto const blocks = held_out_blocks(before.parts[i].left, after.parts[i].left,
                                        std::max<Eigen::Index>(1, before.parts[i].memory_rows));
    paired.insert(paired.end(), blocks.begin(), blocks.end());
  }
  return paired;
}

}  // namespace

double RowsLeft::energy() const {
  double sum = 0.0;
  for (Part const& part : parts) sum += part.left.squaredNorm();
  return sum;
}

bool leaves_clearly_more(RowsLeft const& one, RowsLeft const& best, OfForm const& form) {
  double const explained = std::max(0.0, form.without_any.energy() - best.energy());
  bool const is_beyond_form = one.energy() - best.energy() > form.tolerance * form.tolerance * explained;
  return is_beyond_form &&
         held_out_gain(paired_blocks(one, best), Blocks::where_it_acts).change == HeldOutChange::lower;
}

bool leaves_clearly_less(RowsLeft const& other, RowsLeft const& one) {
  return held_out_gain(paired_blocks(one, other)).change == HeldOutChange::lower;
}

}  // namespace torquescope
