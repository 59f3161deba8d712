#include "engine/diagnose/unseen_floor.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/diagnose/twin_batch.hpp"

namespace torquescope {
namespace {

// disturbance and wander as in training
TwinLoop with_levels_of(ModelStage const& stage, TwinLoop loop) {
  auto const& trained = stage.twin->loop.loop;
  for (double TwinLoop::*level : {&TwinLoop::disturbance_std, &TwinLoop::disturbance_variance_error,
                                  &TwinLoop::friction_wander, &TwinLoop::friction_wander_variance_error})
    loop.*level = trained.*level;
  return loop;
}

}  // namespace

TwinErrors unseen_twin_errors(Recording const& recording, StageSetting const& setting, ModelStage const& stage,
                              RecordedLoop const& loop, Eigen::VectorXd const& parameters) {
  RecordPipeline const pipeline = pipeline_for(setting, recording, stage.model());
  CleanTwin const twin(stage.model().twin_joint(stage.parameters()), with_levels_of(stage, loop.loop), loop.track,
                       stage.twin->twin.step_s());
  std::vector<double> relerr(twin_lanes, unknown);
  for_each_twin(twin, pipeline, {setting.seed, 1, first_free_twin_set}, relerr.size(), setting.threads,
                [&](VisitedTwin const& visited) {
                  if (visited.ran_away) return;
                  auto const& record = visited.record;
                  relerr[visited.index] = (record.torque - record.columns * parameters).norm() / record.torque.norm();
                });
  double sum = 0.0;
  for (double one : relerr) sum += one;
  if (!std::isfinite(sum)) return {};
  return {sum / static_cast<double>(relerr.size()), *std::min_element(relerr.begin(), relerr.end())};
}

RecordedLoop with_law_of(RecordedLoop const& trained, RecordedLoop loop) {
  double const encoder_step = loop.loop.encoder_step;
  loop.source = trained.source;
  loop.loop = trained.loop;
  loop.loop.encoder_step = encoder_step;
  return loop;
}

double floor_below(double relerr, TwinErrors const& twins) { return twins.least <= relerr ? twins.mean : unknown; }

}  // namespace torquescope
