#include "engine/infer/validation/unseen_floor.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace torquescope {
namespace {

// disturbance and wander as in training
TwinLoop with_levels_of(ModelStage const& stage, TwinLoop loop) {
  auto const& trained = stage.twin->loop.loop;
  for (double TwinLoop::*level : {&TwinLoop::disturbance_std, &TwinLoop::disturbance_variance_error,
                                  &TwinLoop::friction_wander, &TwinLoop::friction_wander_variance_error})
    loop.*level = trained.*level;
  loop.sticking = trained.sticking;
  return loop;
}

struct TwinResidual {
  Eigen::VectorXd left;  // empty: it ran away
  double torque = 0.0;   // norm
};

std::vector<TwinResidual> residuals_of_twins(Recording const& recording, StageSetting const& setting,
                                             ModelStage const& stage, RecordedLoop const& loop, TwinRows const& rows) {
  std::vector<TwinResidual> twins(unseen_twins);
  for_each_unseen_twin(recording, setting, stage, loop, rows, [&](VisitedTwin const& visited) {
    auto const& record = visited.record;
    TwinResidual& twin = twins[visited.index];
    twin.left = record.torque - record.columns * stage.estimate();
    twin.torque = record.whole_torque().norm();
  });
  return twins;
}

// empty where one ran away
Eigen::VectorXd mean_of(std::vector<TwinResidual> const& twins) {
  Eigen::VectorXd sum = twins.front().left;
  for (std::size_t i = 1; i < twins.size(); ++i) {
    if (twins[i].left.size() == 0 || sum.size() == 0) return {};
    sum += twins[i].left;
  }
  return sum / static_cast<double>(twins.size());
}

}  // namespace

void for_each_unseen_twin(Recording const& recording, StageSetting const& setting, ModelStage const& stage,
                          RecordedLoop const& loop, TwinRows const& rows,
                          std::function<void(VisitedTwin const&)> const& visit) {
  RecordPipeline pipeline = pipeline_for(setting, recording, stage);
  pipeline.weigh_with(rows.weights);
  if (rows.only != nullptr) pipeline.restrict_to(*rows.only);
  CleanTwin const twin(pipeline.model().twin_joint(stage.estimate()), with_levels_of(stage, loop.loop), loop.track,
                       stage.twin->twin.step_s());
  for_each_twin(twin, pipeline, {setting.seed, 1, first_free_twin_set}, unseen_twins, setting.threads,
                [&](VisitedTwin const& visited) {
                  if (!visited.ran_away) visit(visited);
                });
}

TwinErrors unseen_twin_errors(Recording const& recording, StageSetting const& setting, ModelStage const& stage,
                              RecordedLoop const& loop, TwinRows const& rows) {
  auto twins = residuals_of_twins(recording, setting, stage, loop, rows);
  auto const n = static_cast<double>(twins.size());
  double sum = 0.0, least = std::numeric_limits<double>::infinity();
  Eigen::VectorXd const artefact = rows.without_artefact ? mean_of(twins) : Eigen::VectorXd();
  // a twin is nearer to a mean that it is in than the recording is
  double const nearer = rows.without_artefact ? std::sqrt((n + 1.0) / (n - 1.0)) : 1.0;
  TwinErrors errors;
  for (TwinResidual& twin : twins) {
    if (twin.left.size() == 0) return {};
    if (rows.without_artefact) twin.left -= artefact;
    double const relerr = nearer * twin.left.norm() / twin.torque;
    sum += relerr;
    least = std::min(least, relerr);
  }
  errors.mean = sum / n;
  errors.least = least;
  return errors;
}

Eigen::VectorXd processing_artefact(Recording const& recording, StageSetting const& setting, ModelStage const& stage,
                                    RecordedLoop const& loop, std::vector<Eigen::Index> const& rows) {
  return mean_of(residuals_of_twins(recording, setting, stage, loop, {&rows, true, {}}));
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
