#pragma once
// What a complete model would leave of an unseen recording: the relative errors of twins of it.
//
// Twins      16 of the final model, predicted by the same parameters as the recording; disturbance and wander as in training
// Loop       the one found in that recording; what a law does not explain there is noise of its twins, and a law that lacks something
//            makes them louder than the recording. Then the law of training follows this recording's reference, with the noise it
//            had there
// No floor   a recording that leaves less than every one of its twins does not have their noise (one in 17 by chance): with neither
//            law a floor is known
// Units      1
// Threads    spreads twins over `threads`; same bits for any number

#include "engine/diagnose/diagnosis.hpp"
#include "engine/diagnose/model_stage.hpp"
#include "engine/diagnose/recorded_loop.hpp"

namespace torquescope {

// relerr of twins; unknown where one ran away
struct TwinErrors {
  double mean = unknown, least = unknown;
};

// the twins' own fits are not used: `parameters` predict them.  loop: not tracking
// Errors     as the pipeline
TwinErrors unseen_twin_errors(Recording const& recording, StageSetting const& setting, ModelStage const& stage,
                              RecordedLoop const& loop, Eigen::VectorXd const& parameters);

// the law of training, led by another recording; sampled alike
RecordedLoop with_law_of(RecordedLoop const& trained, RecordedLoop loop);

// their mean where it is a floor to that error; unknown where it is none
double floor_below(double relerr, TwinErrors const& twins);

}  // namespace torquescope
