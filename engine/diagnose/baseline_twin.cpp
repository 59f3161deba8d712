#include "engine/diagnose/baseline_twin.hpp"

#include <utility>

#include "engine/base/error.hpp"

namespace torquescope {
namespace {

struct Attempt {
  RecordedLoop loop;
  BaselineCorrection baseline{};
  DisturbanceLevel disturbance{};
  bool ran_away() const { return baseline.ran_away || disturbance.ran_away; }
};

Attempt attempt(RecordedLoop loop, ProcessedRecord const& record, RecordPipeline const& pipeline,
                TwinOptions const& options, int threads) {
  TwinAddress const correction_set{options.seed, options.recording, 0};
  TwinAddress const level_set{options.seed, options.recording, 1};
  Attempt result{std::move(loop)};
  auto const correct = [&] {
    result.baseline = correct_baseline(record.parameters, result.loop.loop, result.loop.track, pipeline, options.step_s,
                                       correction_set, options.twins, threads);
  };
  correct();
  if (result.baseline.ran_away) return result;
  CleanTwin const twin(make_twin_joint(pipeline.regressor(), result.baseline.parameters), result.loop.loop,
                       result.loop.track, options.step_s);
  result.disturbance = disturbance_level(record, twin, pipeline, options.step_s, level_set, options.twins, threads);
  if (result.disturbance.ran_away || result.disturbance.std == 0.0) return result;
  result.loop.loop.disturbance_std = result.disturbance.std;
  result.loop.loop.disturbance_variance_error = result.disturbance.variance_error;
  correct();
  return result;
}

double fitted_inertia(RecordPipeline const& pipeline, Eigen::VectorXd const& parameters) {
  return make_twin_joint(pipeline.regressor(), parameters).lanes.inertia;
}

}  // namespace

BaselineTwin make_baseline_twin(Recording const& recording, RecordPipeline const& pipeline, FilterOptions const& filter,
                                TwinOptions const& options, int threads) {
  ProcessedRecord record = pipeline.process(recording);
  double const inertia = fitted_inertia(pipeline, record.parameters);
  Attempt made = attempt(recorded_loop(recording, inertia, filter), record, pipeline, options, threads);
  if (made.ran_away() && made.loop.source != LoopSource::tracking) {
    made = attempt(tracking_loop(recording, inertia, filter), record, pipeline, options, threads);
    made.loop.remark = "the loop found in the recording does not hold the fitted joint; " + made.loop.remark;
  }
  validate(!made.ran_away(), [&] {
    Problem problem{ExitCode::bad_data, recording.name + ": the fitted joint runs away from the measured motion"};
    problem.help =
        "the torque column may be another signal or have the wrong sign or unit: check recording.columns and "
        "torque_per_unit";
    return problem;
  });
  CleanTwin twin(make_twin_joint(pipeline.regressor(), made.baseline.parameters), made.loop.loop, made.loop.track,
                 options.step_s);
  return {std::move(record), std::move(made.loop), std::move(made.baseline), made.disturbance, std::move(twin)};
}

}  // namespace torquescope
