#include "engine/infer/decision/fitted_model.hpp"

#include <cmath>
#include <limits>
#include <utility>

#include "engine/data/filter_checks.hpp"
#include "engine/fit/statistics/block_jackknife.hpp"
#include "engine/infer/decision/own_clock.hpp"
#include "engine/infer/decision/score.hpp"

namespace torquescope {
namespace {

// filtered torque on all rows, whatever is weighed
double torque_energy(std::span<Strip const> strips) {
  double energy = 0.0;
  for (auto const& strip : strips) energy += on_rows(strip, strip.torque).squaredNorm();
  return energy;
}

BaselineReference sizes_of(Regressor const& regressor, FittedStrips const& fitted) {
  Strip const& strip = fitted.strips().front();
  Eigen::VectorXd const own = fitted.parameters().head(static_cast<Eigen::Index>(regressor.size()));
  double const band_hz = torque_band_of(strip.filters->options, strip.filters->effects->kept_rate_hz());
  FittedBaseline const sizes = fitted_baseline(regressor, {own.data(), regressor.size()}, strip.motion, band_hz,
                                               strip.resolution, strip.beside.beside_motion());
  return {sizes.scales, own, {}, {}, 0.0};
}

}  // namespace

double JointStrips::torque_rms() const {
  std::size_t rows = 0;
  for (auto const& strip : *training) rows += strip.rows.size();
  return std::sqrt(training_energy / static_cast<double>(rows));
}

void count_torque(JointStrips& rows) {
  rows.training_energy = torque_energy(*rows.training);
  rows.validation_energy = torque_energy(rows.validation);
}

JointStrips joint_strips(DecisionQuestion const& question) {
  JointStrips rows;
  auto const strips = [&](std::span<Recording const> recordings) {
    std::vector<Strip> all;
    for (auto const& one : recordings)
      all.push_back(strip_of(one, strip_filters(one, question.filter, question.filter_section)));
    return all;
  };
  rows.training = share(strips(question.training));
  rows.validation = strips(question.validation);
  count_torque(rows);
  return rows;
}

FittedModel fitted_model(JointStrips const& rows, Regressor const& regressor, std::vector<ShapedEffect> effects,
                         FittedStrips const* sizes, DelayChoice const& delay) {
  FittedModel made;
  made.model = sizes == nullptr
                   ? std::make_unique<JointModel>(regressor)
                   : std::make_unique<JointModel>(regressor, sizes_of(regressor, *sizes), std::move(effects));
  made.fitted = std::make_unique<FittedStrips>(*made.model, rows.training, delay);
  return made;
}

FittedModel fitted_at(JointStrips const& rows, JointModel const& model, double late_s) {
  FittedModel made;
  made.model = std::make_unique<JointModel>(model);
  made.fitted =
      std::make_unique<FittedStrips>(*made.model, rows.training, DelayChoice{DelaySearch::given, 0.0, late_s});
  return made;
}

double validation_error(JointStrips const& rows, FittedModel const& by) {
  if (rows.validation.empty()) return std::numeric_limits<double>::quiet_NaN();
  double energy = 0.0;
  for (auto const& strip : rows.validation) energy += predicted(by, strip).residual.squaredNorm();
  return std::sqrt(energy / rows.validation_energy);
}

double error_on_folds(JointStrips const& rows, FittedModel const& by) {
  Score const score(by.fitted->base(), by.fitted->residual(), by.fitted->guard());
  return std::sqrt(score.left()[0] / rows.training_energy);
}

ModelErrors errors_of(JointStrips const& rows, FittedModel const& by) {
  return {std::sqrt(by.fitted->chosen().fit.energy() / rows.training_energy), error_on_folds(rows, by),
          validation_error(rows, by)};
}

std::vector<FittedNumber> numbers_of(FittedModel const& by) {
  FittedStrips const& fitted = *by.fitted;
  Eigen::VectorXd const deviations = jackknife_deviations(fitted.residual(), fitted.base());
  auto const size = static_cast<Eigen::Index>(by.model->size());
  std::vector<FittedNumber> numbers;
  for (Eigen::Index k = 0; k < size; ++k) numbers.push_back({fitted.parameters()[k], deviations[k]});
  std::size_t shapes = 0;
  for (auto const& one : by.model->effects()) shapes += one.shape.size();
  Eigen::Index at = fitted.base().cols() - static_cast<Eigen::Index>(shapes);
  if (at < fitted.first_tangent() + 2) return numbers;  // some shape has one value only
  for (auto const& one : by.model->effects())
    for (double const value : one.shape) numbers.push_back({value, deviations[at++]});
  return numbers;
}

double delay_deviation(FittedModel const& by) {
  return jackknife_deviations(by.fitted->residual(), by.fitted->base())[by.fitted->first_tangent()];
}

PredictedRows predicted(FittedModel const& by, Strip const& strip) {
  ModelOnStrips const on(*by.model, {&strip, 1});
  double const late_s = by.fitted->chosen().late_s;
  // without the offsets of further recordings
  Eigen::VectorXd const parameters = by.fitted->parameters().head(on.parameters());
  Eigen::VectorXd const carried = without_clock(*by.model, parameters);
  auto const samples = treated_samples(on, late_s, carried, by.fitted->chosen().fit.sticking);
  PredictedRows rows;
  rows.torque = on_rows(strip, strip.torque).col(0);
  rows.residual = torque_on_rows(on, samples, late_s) - model_on_rows(on, samples) * carried;
  Eigen::VectorXd const constant = on_rows(strip, samples.front().weight).col(0);
  if (double const whole = constant.squaredNorm(); whole > 0.0)
    rows.residual -= constant * (constant.dot(rows.residual) / whole);
  rows.residual = less_own_clock({on, samples, parameters, constant}, std::move(rows.residual));
  return rows;
}

}  // namespace torquescope
