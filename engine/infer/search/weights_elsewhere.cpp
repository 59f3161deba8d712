#include "engine/infer/search/weights_elsewhere.hpp"

#include <utility>

#include "engine/infer/replicates/reversal_weights.hpp"
#include "engine/infer/replicates/twin_whitening.hpp"

namespace torquescope {

void weigh_elsewhere(StageSetting const& setting, ModelStage const& stage, Recording const& recording,
                     Eigen::VectorXd const& parameters, RecordedLoop const* loop, std::uint32_t index,
                     RecordPipeline& pipeline) {
  if (!stage.pipeline->whitens()) return;
  NoiseWeights const& trained = *stage.pipeline->weights();
  RecordedLoop const& led = loop != nullptr ? *loop : stage.twin->loop;
  BaselineTwin here{pipeline.prepare(recording),
                    led,
                    stage.twin->baseline,
                    stage.twin->disturbance,
                    stage.twin->friction_wander,
                    stage.twin->colour,
                    CleanTwin(pipeline.model().twin_joint(parameters), led.loop, led.track, stage.twin->twin.step_s())};
  here.baseline.parameters = parameters;
  NoiseWeights rows(trained.rows());
  if (loop != nullptr && trained.weigh_reversals())
    rows = reversal_weights(here, pipeline, trained.rows(), {setting.seed, index, first_free_twin_set + 2},
                            twins_per_round, setting.workers());
  pipeline.weigh_with(std::make_shared<NoiseWeights const>(with_wander_of(here, rows, pipeline)));
}

}  // namespace torquescope
