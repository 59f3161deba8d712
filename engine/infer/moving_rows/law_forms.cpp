#include "engine/infer/moving_rows/law_forms.hpp"

#include "engine/effects/carry_over.hpp"
#include "engine/fit/statistics/hat_functions.hpp"
#include "engine/infer/locate/map_axes.hpp"

namespace torquescope {
namespace {

constexpr Eigen::Index n_knots = 12;

Eigen::MatrixXd forms_of(Effect const& effect, MotionAxes const& axes) {
  SignatureAxis const axis = effect.signature().front();
  Eigen::VectorXd const at = values_on(axis, axes);
  Eigen::MatrixXd any = hats(axis == SignatureAxis::velocity ? at.cwiseAbs() : at, n_knots);
  Eigen::MatrixXd along_motion = any;
  along_motion.array().colwise() *= axes.dq.array().sign();
  if (effect.parity() == Parity::even) return any;
  if (effect.parity() == Parity::odd) return along_motion;
  Eigen::MatrixXd both(any.rows(), 2 * any.cols());
  both << any, along_motion;
  return both;
}

bool has_forms(Effect const& effect) {
  return !effect.signature().empty() && !effect.is_given() && !is_spectrum(effect.signature().front()) &&
         !is_clock_bound(effect);
}

}  // namespace

Eigen::MatrixXd forms_of_laws(ModelStage const& stage, JointModel const& model, ProcessedRecord const& record,
                              std::size_t without) {
  auto const& effects = stage.model().effects();
  Eigen::MatrixXd all(record.motion->q.size(), 0);
  for (std::size_t i = 0; i < effects.size(); ++i) {
    if (i == without || !has_forms(*effects[i].effect)) continue;
    Eigen::MatrixXd const own = forms_of(*effects[i].effect, motion_axes(model, record, stage.parameters()));
    all.conservativeResize(Eigen::NoChange, all.cols() + own.cols());
    all.rightCols(own.cols()) = own;
  }
  return all;
}

}  // namespace torquescope
