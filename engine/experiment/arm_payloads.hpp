#pragma once
// Which payload an arm carries in which recording, as a job says it.
//
// Same       recordings of one mass and one set of first moments carry the same payload; what is not known of it is
//            found once
// Errors     Problems (78): not as many numbers as recordings, a mass below 0, a validation payload that no training
//            recording carries; drive gains without two recordings of different payloads, or on an arm whose torques a
//            mass cannot scale; iv beside drive gains
// Threads    free functions

#include <optional>
#include <string>
#include <vector>

#include "engine/experiment/experiment_parts.hpp"
#include "engine/fit/problem/least_squares.hpp"

namespace torquescope {

// of each recording, an index into PayloadPlan::payloads
using CarriedPayloads = std::vector<std::optional<std::size_t>>;

struct PayloadPlan {
  std::vector<Payload> payloads{};
  CarriedPayloads train{}, validate{};
};

PayloadPlan plan_payloads(Job const& job, RecordingOptions const& options, bool has_drive_gains,
                          std::vector<Problem>& problems);

// mass and centre of each load of unknown mass, with their 95 % intervals by HAC errors; "" where there is none
std::string payload_words(ArmModel const& model, LeastSquaresFit const& fit);

// once the arm is known
void refuse_useless_payloads(Experiment::Parts const& parts, std::vector<Problem>& problems);

}  // namespace torquescope
