#pragma once
// How much of a search's evaluations a population deserves: the rules of FADE over its relative movement.
//
// Inputs     PC, FC in units of spreads (movement.hpp), as powers of ten: small 0.01, middle 0.1, big 1
// Output     share: small 0.1, middle 0.5, big 0.9; weighted average, so it stays between 0.1 and 0.9
// Scale      no unit of parameters or fitness enters
// Threads    const object, any number of threads
// Source     rules: Liu, Lampinen: Soft Computing 9 (2005) 448-462; inputs, sets and use are ours

#include "engine/fit/optim/mamdani.hpp"
#include "engine/fit/optim/movement.hpp"

namespace torquescope {

class MovementShare {
 public:
  MovementShare();
  double operator()(Movement const& of_population) const;

 private:
  MamdaniSystem system_;
};

}  // namespace torquescope
