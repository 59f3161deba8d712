#pragma once
// How far recordings differ from their simulation, and replicates of it among themselves.
//
// Random     addressed by the question's seed
// Threads    spreads over the question's threads; same bits for any number of them

#include "engine/infer/decision/servo_decision.hpp"
#include "engine/infer/decision/servo_verdict.hpp"

namespace torquescope {

ServoFit servo_fit(ServoQuestion const& question, ServoDecision const& decision);

}  // namespace torquescope
