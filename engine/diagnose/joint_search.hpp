#pragma once
// The search at one joint: on the rows between reversals, and where these are too few, on all rows in motion.
//
// Weighed    rows at reversals count by their noise (reversal_rows.hpp), where the rows between reversals are too few
// Errors     Error 78 as search_stepwise; a motion that cannot carry a search is told in the answer
// Threads    free function
// Source     METHOD.md, Reversal mask

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/diagnose/first_look.hpp"
#include "engine/diagnose/search_in_time.hpp"
#include "engine/infer/moving_rows/kept_model.hpp"

namespace torquescope {

// what is the same in every attempt; all of it outlives the answer
struct JointQuestion {
  DiagnosisInput const& input;
  FirstLook const& first_look;
  bool has_reference = false;  // one that tells a loop
  DecisionLevels levels{};
  StageSink const& progress;
};

struct SearchedJoint {
  std::unique_ptr<Recording> recording{};  // what the search's setting refers to
  OwnedRecordings others{};                // torque in time with that of the recording
  double torque_late_s = 0.0;              // taken out of all of them (channel_timing.hpp)
  std::vector<std::string> too_short{};    // recordings to predict that were left out
  std::unique_ptr<StepwiseSearch const> search{};
  KeptModel kept{};
};

struct JointSearchAnswer {
  SearchedJoint found{};
  std::optional<Hopeless> why{};  // nothing was found because of it
};

JointSearchAnswer search_joint(JointQuestion const& question, Recording const& recording,
                               OwnedRecordings const& others);

// the smallest share of the torque that could have been seen to be missing; of validation rows the replicates' error
double visible_share(ModelStage const& baseline, double unseen_floor);

}  // namespace torquescope
