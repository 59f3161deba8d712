#pragma once
// What a job says about simulating its recordings: [loop], [[model.effects]], [model.given], and the recordings as
// tracks of a rollout. Made once where an estimator searches by rollouts, or for a replay.
//
// Loop       the gains that [loop] leaves out begin at least squares on the recordings (rollout/loop_gains.hpp);
//            controller = "identified" finds a controller in each recording
// Start      least squares on the rows of the job, a parameter of [model.given] as it is written
// Errors     problems are appended (78), or thrown with those of track_of()
// Threads    plain records, free functions

#include <Eigen/Core>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "engine/data/motion.hpp"
#include "engine/effects/regressor.hpp"
#include "engine/experiment/job/job.hpp"
#include "engine/fit/optim/objective.hpp"
#include "engine/fit/problem/regression_data.hpp"
#include "engine/simulate/rollout/loop_options.hpp"
#include "engine/simulate/rollout/rollout_model.hpp"

namespace torquescope {

struct ServoJob;

// where a track's loop comes from
enum class LoopOrigin { given, fitted, identified, approximated, none };
std::string word(LoopOrigin origin);

struct RolloutData {
  std::vector<Recording> recordings;
  std::vector<RolloutTrack> tracks{};       // one per recording
  std::vector<LoopOrigin> origins{};        // of each track's loop
  std::vector<std::string> loop_words{};    // a sentence each
  std::vector<Eigen::VectorXd> velocity{};  // [n] as it was derived
};

// what the text alone says
struct RolloutPlan {
  LoopOptions loop{};
  std::vector<ModelEffect> effects{};
  std::map<std::string, double> given{};  // of [model.given]
  bool is_servo = false;                  // of [[recordings]]: what is known of each comes with its data
};

RolloutPlan plan_rollouts(Job const& job, Regressor const& regressor, std::vector<Problem>& problems);

struct RolloutParts {
  RolloutPlan plan;
  std::vector<std::string> names, units;  // of all parameters, known before the data
  RolloutData train{}, validate{};
  Eigen::VectorXd least_squares{};  // of the regressor, as fitted; the start of the model may differ
  std::optional<RolloutModel> model{};
  ChannelNumbers variance{};  // of each channel's residual at the start: what a search weighs it by
};

// names and units of all parameters
RolloutParts begin_rollouts(RolloutPlan plan, Regressor const& regressor);

// recordings with all their channels; rows: those of the fit, for its least squares
void add_recordings(RolloutParts& rollout, Regressor const& regressor, std::vector<Recording> train,
                    std::vector<Recording> validate, RegressionData const& rows, FilterOptions const& filter,
                    Section const& filter_section);

// the same of servos: their tracks know their loads, and their start is theirs (decision/servo_start.hpp)
void add_servo(RolloutParts& rollout, Regressor const& regressor, ServoJob const& servo, RegressionData const& rows);

// tracks of other recordings with the same loop
RolloutData rollout_data(std::vector<Recording> recordings, LoopOptions const& loop, FilterOptions const& filter,
                         Section const& filter_section);

// mean square of what the start leaves of each channel; of the channel itself where the start runs away
ChannelNumbers variance_at_start(RolloutParts const& rollout);

// of a population method: plausible sizes round the start
Bounds rollout_box(RolloutModel const& model);

}  // namespace torquescope
