#include "engine/diagnose/column_export.hpp"

#include <span>
#include <utility>

#include "engine/base/parallel.hpp"
#include "engine/data/from_zero.hpp"
#include "engine/infer/decision/effect_shape.hpp"
#include "engine/infer/decision/sticking_shape.hpp"
#include "engine/infer/pipeline/simulator_gap.hpp"

namespace torquescope {
namespace {

struct PlainRecordings {
  Recording train{};
  std::vector<Recording> validate{};
};

PlainRecordings less_simulator(DiagnosisInput const& input) {
  PlainRecordings all{from_zero(input.train), {}};
  for (auto const& one : input.validate) all.validate.push_back(from_zero(one));
  if (all.train.simulated_torque.size() == 0) return all;
  auto const pipeline = [&](Recording const& one) {
    return RecordPipeline(input.regressor, input.filter, one.rate_hz, one.position.size(), input.filter_section);
  };
  SimulatorGap gap = gap_to_simulator(all.train, pipeline(all.train));
  all.train = std::move(gap.recording);
  for (auto& one : all.validate) {
    RecordPipeline const own = pipeline(one);
    one = without_simulator(std::move(one), own, gap.simulator_parameters);
  }
  return all;
}

// of candidates at their shapes, as the model treats the samples of one recording
RecordColumns record_columns(std::string name, FittedModel const& by, Strip const& strip,
                             std::vector<ShapedCandidate> const& candidates) {
  auto const& filter = *strip.filters->effects;
  ModelOnStrips const on(*by.model, {&strip, 1});
  auto const samples =
      treated_samples(on, 0.0, by.fitted->parameters().head(on.parameters()), by.fitted->chosen().fit.sticking);
  auto const at_rows = [&](Eigen::VectorXd const& signal) { return Eigen::VectorXd(filter.pick(signal)(strip.rows)); };
  Motion const& motion = strip.motion;
  RecordColumns made;
  made.recording = std::move(name);
  made.kept_rate_hz = filter.kept_rate_hz() / static_cast<double>(strip.rows_apart);
  made.cutoff_hz = strip.filters->cutoff_hz;
  for (Eigen::Index const row : strip.rows) made.kept_rows.push_back(row / strip.rows_apart);
  made.time_s = at_rows(motion.time_s);
  made.q = at_rows(motion.q);
  made.dq = at_rows(motion.dq);
  made.ddq = at_rows(motion.ddq);
  made.torque = torque_on_rows(on, samples, 0.0);
  made.regressor = model_on_rows(on, samples);
  for (auto const& [effect, shape, points, gain] : candidates)
    made.candidates.push_back(on_rows(strip, columns_of(*effect, {shape}, strip, on.baseline(0)), samples.front().side,
                                      samples.front().weight));
  return made;
}

}  // namespace

ColumnExport export_columns(DiagnosisInput const& input) {
  PlainRecordings const all = less_simulator(input);
  DecisionQuestion const question{{&all.train, 1}, all.validate, input.regressor, input.filter, input.filter_section};
  JointStrips const strips = joint_strips(question);
  DelayChoice const as_read{DelaySearch::given, 0.0, 0.0};
  FittedModel const plain = fitted_model(strips, input.regressor, {}, nullptr, as_read);
  FittedModel const model = fitted_model(strips, input.regressor, {}, plain.fitted.get(), as_read);
  JointScales const& scales = model.model->reference().scales;
  std::vector<Effect const*> effects;
  for (auto const* effect : input.candidates)
    if (effect->exists_on(scales.joint)) effects.push_back(effect);
  auto const questions =
      effect_questions(effects, scales, sticking_bounds(strips.training->front().resolution).most_length);
  FittedStrips const& fitted = *model.fitted;
  Score const score(fitted.chosen().fit.columns, fitted.residual(), fitted.guard());
  auto const found = scan_recording(questions, fitted, score, input.threads);
  std::vector<RefinedEffect> refined(questions.size());
  parallel_for(questions.size(), input.threads, [&](std::size_t i, int) {
    refined[i] = refined_effect(questions[i], found[i], fitted, score, input.numbers.least_fall);
  });
  auto const n = static_cast<double>(fitted.residual().size());
  ColumnExport result;
  for (std::size_t i = 0; i < questions.size(); ++i) {
    if (refined[i].rms > 0.0)
      result.candidates.push_back(
          {questions[i].effect, refined[i].shape, questions[i].grid.size(), refined[i].rms * refined[i].rms * n});
    else
      result.not_testable.push_back(questions[i].effect);
  }
  result.train = record_columns(all.train.name, model, strips.training->front(), result.candidates);
  for (std::size_t k = 0; k < all.validate.size(); ++k)
    result.validate.push_back(record_columns(all.validate[k].name, model, strips.validation[k], result.candidates));
  return result;
}

}  // namespace torquescope
