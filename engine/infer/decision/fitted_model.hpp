#pragma once
// One model of a joint fitted to its training recordings, and what it leaves of them and of others.
//
// Errors     ||residual|| / ||torque|| over all rows of the filtered torque; inside the interval of static friction a
//            residual is zero. Of other recordings the offset is fitted, and what effects of a clock are there
// Threads    plain records, pure functions
// Source     engine/infer/decision/THEORY.md, Rows

#include <memory>
#include <vector>

#include "engine/infer/decision/decision_facts.hpp"
#include "engine/infer/decision/decision_question.hpp"
#include "engine/infer/decision/effect_scan.hpp"

namespace torquescope {

struct JointStrips {
  SharedStrips training = share({});
  std::vector<Strip> validation{};
  double training_energy = 0.0, validation_energy = 0.0;  // of the torque
  double torque_rms() const;                              // in training
};

// both energies anew, of weighed rows
void count_torque(JointStrips& rows);
// Errors     Error 78, 65 as strip_filters()
JointStrips joint_strips(DecisionQuestion const& question);

struct FittedModel {
  std::unique_ptr<JointModel> model{};
  std::unique_ptr<FittedStrips> fitted{};
};

// sizes: a fit that tells the sizes of the joint, which effects are relative to; none: of a model without effects
FittedModel fitted_model(JointStrips const& rows, Regressor const& regressor, std::vector<ShapedEffect> effects,
                         FittedStrips const* sizes, DelayChoice const& delay);

// the same model fitted to these rows with a delay that is given
FittedModel fitted_at(JointStrips const& rows, JointModel const& model, double late_s);

ModelErrors errors_of(JointStrips const& rows, FittedModel const& by);
// on held-out folds of training
double error_on_folds(JointStrips const& rows, FittedModel const& by);
double validation_error(JointStrips const& rows, FittedModel const& by);  // NaN without validation recordings

// values with their deviations over tenths of the rows: of the model's columns, then of the effects' shapes
std::vector<FittedNumber> numbers_of(FittedModel const& by);
double delay_deviation(FittedModel const& by);

// of a recording that is predicted by a fit: on its rows, its own offset taken out
struct PredictedRows {
  Eigen::VectorXd residual{}, torque{};
};
PredictedRows predicted(FittedModel const& by, Strip const& strip);

}  // namespace torquescope
