#pragma once
// The verdict on many recordings of servos: from facts, by one table.
//
// Table      the model predicts nothing: insufficient. Names: the strongest with rivals alone is a class; named where
//            what is left is what replicates have, else partly. No name: none where it is, else unexplained
// Adequate   the rms of what is left is at most a step of the encoder, or `spread_times` that of replicates without
//            noise, whose encoders lie elsewhere and which begin elsewhere within a step: closer no simulation can be
// Threads    pure function

#include <algorithm>

#include "engine/infer/decision/loop_facts.hpp"
#include "engine/infer/verdict/diagnosis.hpp"

namespace torquescope {

struct ServoFit {
  double left_rms = 0.0, replicates_rms = 0.0;  // of the position, rad, all samples of training
  double encoder_step = 0.0;                    // rad; 0: too fine to see

  bool is_adequate() const {
    constexpr double spread_times = 2.0;
    return left_rms <= std::max(encoder_step, spread_times * replicates_rms);
  }
};

Verdict servo_verdict(LoopFacts const& facts, ServoFit const& fit);

}  // namespace torquescope
