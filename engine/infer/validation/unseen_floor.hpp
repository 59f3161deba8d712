#pragma once
// What a complete model would leave of a validation recording: the relative errors of its replicates.
//
// Replicates 16 of the final model, predicted by the same parameters as the recording; noise levels as in training
// Loop       the one found in that recording; when its replicates are louder than the recording, the law of training
//            with the noise it had there
// No floor   a recording that leaves less than every replicate has not their noise (one in 17 by chance)
// Reversals  where their rows stay in, the replicates' mean residual is an artefact of processing; it is subtracted
//            from the recording's residual and from theirs
// Units      1; artefact: N m or N
// Threads    spreads replicates over `threads`; same bits for any number

#include <functional>
#include <memory>
#include <vector>

#include "engine/infer/pipeline/recorded_loop.hpp"
#include "engine/infer/replicates/twin_batch.hpp"
#include "engine/infer/search/model_stage.hpp"
#include "engine/infer/verdict/diagnosis.hpp"

namespace torquescope {

inline constexpr std::size_t unseen_twins = twin_lanes;

// relerr of twins; unknown where one ran away
struct TwinErrors {
  double mean = unknown, least = unknown;
};

// rows of twins: none: each twin's own
struct TwinRows {
  std::vector<Eigen::Index> const* only = nullptr;
  bool without_artefact = false;                  // theirs is to be taken out
  std::shared_ptr<NoiseWeights const> weights{};  // none: rows count alike
};

// each once, from any thread; not one that ran away
void for_each_unseen_twin(Recording const& recording, StageSetting const& setting, ModelStage const& stage,
                          RecordedLoop const& loop, TwinRows const& rows,
                          std::function<void(VisitedTwin const&)> const& visit);

// the twins' own fits are not used: the parameters of `stage` predict them. loop: not tracking
// Errors     as the pipeline
TwinErrors unseen_twin_errors(Recording const& recording, StageSetting const& setting, ModelStage const& stage,
                              RecordedLoop const& loop, TwinRows const& rows = {});

// [rows]; empty where a twin ran away
Eigen::VectorXd processing_artefact(Recording const& recording, StageSetting const& setting, ModelStage const& stage,
                                    RecordedLoop const& loop, std::vector<Eigen::Index> const& rows);

// the law of training, led by another recording; sampled alike
RecordedLoop with_law_of(RecordedLoop const& trained, RecordedLoop loop);

// their mean where it is a floor to that error; unknown where it is none
double floor_below(double relerr, TwinErrors const& twins);

}  // namespace torquescope
