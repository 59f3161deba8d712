#pragma once
// The search, begun again when it shows that the torque channel was read elsewhere within its sample.
//
// Rule       a delay of at most a sample is a convention of the log (channel_timing.hpp): it is taken out of all
//            recordings and the search begins again, twice at most: the second for what other laws hid of it
// Loop       a controller's law is one of the torque as its rows say it: put back in time the torque may not be what it
//            answers. Then the loop that was found before stays
// Errors     as search_stepwise
// Threads    as the stages

#include <memory>
#include <vector>

#include "engine/infer/moving_rows/stepwise.hpp"

namespace torquescope {

struct SearchRules {
  SelectionOptions options{};
  DecisionLevels levels{};
};

// all others of a joint: the first so many belong to training
struct OwnedRecordings {
  std::vector<Recording> all{};
  std::size_t training = 0;
  OtherRecordings others() const {
    std::span<Recording const> const whole = all;
    return {whole.first(training), whole.subspan(training)};
  }
};

// recording: what the setting refers to; it, the others and late_s are changed when the torque is put in time
std::unique_ptr<StepwiseSearch const> search_in_time(StageSetting& setting, Recording& recording,
                                                     OwnedRecordings& others, SearchRules const& rules, double& late_s,
                                                     StageSink const& progress);

}  // namespace torquescope
