#pragma once
// What a complete model would leave of an unseen recording: the relative errors of twins of it.
//
// Twins      16 of the final model, predicted by the same parameters as the recording; disturbance and wander as in
//            training
// Loop       the one found in that recording; what a law does not explain there is noise of its twins, and a law that
//            lacks something makes them louder than the recording. Then the law of training follows this recording's
//            reference, with the noise it had there
// No floor   a recording that leaves less than every one of its twins does not have their noise (one in 17 by chance):
//            with neither law a floor is known
// Reversals  where rows at reversals stay in, the filtered velocity misplaces the sign of friction by a few samples,
//            and what that makes of a complete model outweighs what a law of sticking explains. It is the same in
//            twins, which reverse where the recording does: their mean residual is the artefact, taken out of the
//            recording's residual and of their own
// Units      1; artefact: N m or N
// Threads    spreads twins over `threads`; same bits for any number

#include <functional>
#include <vector>

#include "engine/pipeline/recorded_loop.hpp"
#include "engine/search/model_stage.hpp"
#include "engine/statistics/prediction_energies.hpp"
#include "engine/twin/twin_batch.hpp"
#include "engine/verdict/diagnosis.hpp"

namespace torquescope {

inline constexpr std::size_t unseen_twins = twin_lanes;

// each once, from any thread; not one that ran away. Records are prepared and not fitted; rows: as below
void for_each_unseen_twin(Recording const& recording, StageSetting const& setting, ModelStage const& stage,
                          RecordedLoop const& loop, std::vector<Eigen::Index> const* rows,
                          std::function<void(VisitedTwin const&)> const& visit);

// relerr of twins; unknown where one ran away
struct TwinErrors {
  double mean = unknown, least = unknown;
  // one each; empty where an artefact was taken out, which is another for the baseline
  std::vector<PredictionEnergies> predicted{};
  // relerr of each with each fit of training's twins (unseen_transfer.hpp); empty as above
  std::vector<double> transferred{};
};

// rows of twins: none: each twin's own
struct TwinRows {
  std::vector<Eigen::Index> const* only = nullptr;
  bool without_artefact = false;  // theirs is to be taken out
};

// the twins' own fits are not used: the parameters of `stage` predict them (for `transferred` moved as fits of
// training's twins are), and those of the baseline, `baseline`, without its effects. loop: not tracking
// Errors     as the pipeline
TwinErrors unseen_twin_errors(Recording const& recording, StageSetting const& setting, ModelStage const& stage,
                              RecordedLoop const& loop, Eigen::VectorXd const& baseline, TwinRows const& rows = {});

// [rows]; empty where a twin ran away
Eigen::VectorXd processing_artefact(Recording const& recording, StageSetting const& setting, ModelStage const& stage,
                                    RecordedLoop const& loop, std::vector<Eigen::Index> const& rows);

// the law of training, led by another recording; sampled alike
RecordedLoop with_law_of(RecordedLoop const& trained, RecordedLoop loop);

// their mean where it is a floor to that error; unknown where it is none
double floor_below(double relerr, TwinErrors const& twins);

}  // namespace torquescope
