#pragma once
// The short time in which something pushes the last link of an arm: a wrench there explains what all joints lack then,
// and at no other time one explains nearly as much.
//
// Equation   r_j(t) = (J(q)' w)_j / noise_j; r: what the fit of other rows leaves, w: one wrench along the base's axes
// Statistic  energy that w explains, in windows from 0.2 to 2 s; all others of the recording are the null distribution
// Not told   what shows at one joint alone, at an end of the recording, or more than once
// Positions  of all joints, from the rows of the fit and the others: instants without one are not looked at
// Units      s on the recording's own clock; N
// Threads    pure function

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "engine/fit/problem/regression_data.hpp"
#include "engine/robot/serial_chain.hpp"

namespace torquescope {

// conventions, without a source outside
struct TipTouchNumbers {
  double elsewhere = 20.0;  // times the energy of any other window of this length: friction that is missing has few
  double explained = 0.5;   // of the energy that is left in the window, by one wrench
  double stands_out = 3.0;  // noises (rms in the window) at two joints at least
  double shortest_s = 0.2, longest_s = 2.0, longer = 1.5;  // windows, each so many times the one before
  double margin_s = 0.3;                                   // beside a touch: what the filters smear
  double of_force = 0.9;                                   // of the energy, by a force through the tip's origin
  // of the greatest speed: where friction that the model lacks may fade
  std::array<double, 4> slow{0.01, 0.03, 0.1, 0.3};
};

struct TipTouch {
  std::size_t file = 0;
  double from_s = 0.0, until_s = 0.0;
  std::vector<std::size_t> joints{};  // that feel it
  std::optional<double> force{};      // N at the tip's origin; none: it acts elsewhere on the link, or is a moment
};

// rows: of the fit; others: those that it leaves out
std::optional<TipTouch> find_tip_touch(RegressionData const& rows, RegressionData const& others,
                                       SerialChain const& chain, TipTouchNumbers const& numbers = {});

}  // namespace torquescope
