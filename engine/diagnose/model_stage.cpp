#include "engine/diagnose/model_stage.hpp"

#include <utility>

#include "engine/base/error.hpp"

namespace torquescope {
namespace {

ModelStage made_stage(StageSetting const& setting, JointModel model) {
  auto pipeline = std::make_unique<RecordPipeline>(std::move(model), setting.filter, setting.recording.rate_hz,
                                                   setting.recording.position.size(), setting.filter_section);
  TwinOptions options;
  options.seed = setting.seed;
  options.wander = setting.wander;
  options.loop = setting.loop;
  options.twins = 2 * twin_lanes;  // two threads have something to do
  BaselineTwin made = make_baseline_twin(setting.recording, *pipeline, setting.filter, options, setting.threads);
  ablate_twin(made, *pipeline, setting.ablation);
  TwinAddress const null_set{setting.seed, options.recording, first_free_twin_set};
  TwinComparison comparison =
      compare_with_twins(setting.recording, made.twin, *pipeline, null_set, setting.twins, setting.threads);
  if (!comparison.ran_away) replace_null(comparison, setting.ablation.null, setting.seed, setting.threads);
  ModelStage stage{std::move(pipeline), std::move(made), std::move(comparison), {}};
  if (!stage.comparison.ran_away) stage.energy = mismatch_energy(stage.comparison.rows);
  return stage;
}

}  // namespace

BaselineReference ModelStage::reference() const {
  auto const& regressor = model().regressor();
  Eigen::VectorXd const own = parameters().head(static_cast<Eigen::Index>(regressor.size()));
  FittedBaseline const baseline =
      fitted_baseline(regressor, {own.data(), regressor.size()}, twin->record.motion,
                      pipeline->cutoff_hz() > 0.0 ? pipeline->cutoff_hz() : 0.4 * pipeline->kept_rate_hz(),
                      twin->loop.loop.encoder_step);
  return {baseline.scales, own};
}

std::optional<ModelStage> make_stage(StageSetting const& setting, JointModel model) {
  bool const is_baseline = model.effects().empty();
  try {
    ModelStage stage = made_stage(setting, std::move(model));
    if (stage.comparison.ran_away) return std::nullopt;
    return stage;
  } catch (Error const&) {
    // a baseline that cannot be fitted or simulated is the recording's fault; with an effect it is the effect's
    if (is_baseline) throw;
    return std::nullopt;
  }
}

}  // namespace torquescope
