#include "engine/infer/replicates/ablation.hpp"

namespace torquescope {
namespace {

TwinLoop louder(TwinLoop loop, double factor) {
  loop.torque_noise.std *= factor;
  loop.torque_noise.innovation *= factor;
  loop.slow_torque_noise.std *= factor;
  loop.slow_torque_noise.innovation *= factor;
  loop.disturbance_std *= factor;
  loop.position_noise_std *= factor;
  loop.friction_wander *= factor;
  // of squares
  loop.disturbance_variance_error *= factor * factor;
  loop.friction_wander_variance_error *= factor * factor;
  return loop;
}

}  // namespace

void ablate_twin(BaselineTwin& made, RecordPipeline const& pipeline, Ablation const& ablation) {
  if (!ablation.changes_twins()) return;
  if (!ablation.indirect_inference) made.baseline.parameters = made.record.parameters;
  // the loop stays as found: later models of the recording begin with it
  made.twin = CleanTwin(pipeline.model().twin_joint(made.baseline.parameters),
                        louder(made.loop.loop, ablation.twin_noise), made.loop.track, made.twin.step_s());
}

}  // namespace torquescope
