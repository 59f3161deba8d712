#include "engine/infer/moving_rows/adequacy.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/fit/statistics/twin_null.hpp"

namespace torquescope {

namespace {

// few replicates cannot give a small p: then none of them reaches it
double least_chance(DecisionLevels const& levels, std::size_t twins) {
  return std::max(levels.alpha / questions_of_adequacy, least_p(twins));
}

}  // namespace

AdequacyPart adequacy_part(Eigen::VectorXd const& left, double allowed, double torque, DecisionLevels const& levels) {
  AdequacyPart part;
  std::vector<double> const twins(left.data() + 1, left.data() + left.size());
  double const mean = left.tail(left.size() - 1).mean();
  double const excess = left[0] - allowed - mean;
  part.p = empirical_p(left[0] - allowed, twins);
  part.excess_share = torque > 0.0 ? std::sqrt(std::max(0.0, excess) / torque) : 0.0;
  part.holds = part.p > least_chance(levels, twins.size()) || part.excess_share < levels.delta;
  return part;
}

namespace {

// replicates of training as if they had as many rows
AdequacyPart beside_training(Evidence const& evidence, UnseenResidual const& unseen, double allowed,
                             DecisionLevels const& levels) {
  double const rows = static_cast<double>(unseen.rows) / static_cast<double>(evidence.training().basis().rows());
  Eigen::VectorXd left = rows * evidence.left_in_folds().colwise().sum().transpose();
  left[0] = unseen.left;
  return adequacy_part(left, rows * allowed, unseen.torque, levels);
}

// The same of the torque itself, before rows are weighed: weights make little of what friction that wanders could be,
// whatever its size
AdequacyPart in_torque_itself_part(Evidence const& evidence, double of_form, DecisionLevels const& levels) {
  ModelStage const& stage = evidence.stage();
  auto const& rows = stage.comparison.rows;
  if (rows.plain_residual.size() == 0) return {};
  double laws = 0.0;
  auto const& effects = stage.model().effects();
  for (std::size_t i = 0; i < effects.size(); ++i) {
    auto const first = static_cast<Eigen::Index>(stage.model().first_parameter(i));
    laws += (evidence.columns().plain_columns(*effects[i].effect, effects[i].shape) *
             stage.parameters().segment(first, static_cast<Eigen::Index>(effects[i].effect->n_linear())))
                .squaredNorm();
  }
  Eigen::MatrixXd signals = exchangeable(rows.plain_residual, rows.plain_twins);
  stage.pipeline->take_shares(signals, rows.kept_rows);
  Eigen::VectorXd const left = signals.colwise().squaredNorm().transpose();
  return adequacy_part(left, of_form * laws, rows.torque.squaredNorm(), levels);
}

}  // namespace

bool leaves_chance(Evidence const& evidence, LawGain const& law, FoldKind kind, DecisionLevels const& levels) {
  auto const is_chance = [&](Eigen::VectorXd const& left) {
    std::vector<double> const twins(left.data() + 1, left.data() + left.size());
    return empirical_p(left[0], twins) > least_chance(levels, twins.size());
  };
  Eigen::VectorXd const train = evidence.left_in_folds(kind).colwise().sum().transpose() - law.train;
  if (!is_chance(train)) return false;
  return evidence.n_unseen() == 0 || is_chance(evidence.left_unseen().colwise().sum().transpose() - law.unseen);
}

Adequacy adequacy_of(Evidence const& evidence, DecisionLevels const& levels) {
  ModelStage const& stage = evidence.stage();
  double const of_form = levels.tolerance * levels.tolerance;
  double laws = 0.0;
  for (std::size_t i = 0; i < stage.model().effects().size(); ++i) laws += evidence.training().law_energy(i);
  Adequacy result;
  AdequacyPart const itself = in_torque_itself_part(evidence, of_form, levels);
  result.train = adequacy_part(evidence.left_in_folds().colwise().sum().transpose(), of_form * laws,
                               evidence.training().torque_energy(), levels);
  result.train.holds = result.train.holds && itself.holds;
  Eigen::VectorXd const& forms = evidence.by_forms();
  double const of_chance = forms.tail(forms.size() - 1).maxCoeff();
  if (forms[0] > of_chance + of_form * laws) result.train.holds = false;
  if (evidence.n_unseen() > 0)
    result.unseen = adequacy_part(evidence.left_unseen().colwise().sum().transpose(),
                                  of_form * evidence.law_energy_unseen(), evidence.torque_energy_unseen(), levels);
  for (UnseenResidual const& one : evidence.without_replicates()) {
    if (one.rows == 0) continue;
    AdequacyPart const part = beside_training(evidence, one, of_form * laws, levels);
    if (part.holds) continue;
    result.unseen = part;
  }
  return result;
}

}  // namespace torquescope
