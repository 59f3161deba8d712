#pragma once
// The ladder: effects and command-side numbers of a joint decided by simulating its recordings in the loop.
//
// Base       the model fitted by simulation, with the free numbers of its loop
// Step       every move beside each model of a beam: chance by replicates (loop_scan.hpp), then the fit, warm from its
//            parent. A move is taken where p <= alpha, its fit gains, no number is at a bound, and the error of
//            recordings that no fit has seen falls by least_fall; of training where there are none. A delay below half
//            a sample is none
// Then       moves that became useless are removed; moves that fit about as well in the place of one are its class
// Tracks     any number; all share the parameters and the loop
// Threads    spreads moves and fits over the question's threads; same bits for any number
// Source     engine/infer/decision/THEORY.md, In the loop

#include "engine/infer/decision/loop_model.hpp"

namespace torquescope {

struct LoopClimb {
  LoopFacts facts;          // their loop_error is the caller's
  LoopFit base{}, final{};  // of nothing where the base has failed
};
// starts: of the base, the best is taken; none: the question's own
LoopClimb climb_ladder(LoopQuestion const& question, std::vector<LoopPoint> const& starts = {});

}  // namespace torquescope
