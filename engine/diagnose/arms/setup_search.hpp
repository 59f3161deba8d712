#pragma once
// What may be wrong with an arm's set-up: signs, exchanged columns, zeros, units, the convention of its file, gravity's
// direction. Asked before any physics, because a wrong set-up looks like all of it.
//
// How        every single change is fitted by products alone (setup_fit.hpp). Those that halve the held-out error of a
//            joint and make no other worse begin a row of up to three; the row that leaves least is taken
// Not told   what the motion cannot tell: a vertical first joint has no zero; the last links of most arms no sign. A
//            change that only gives other parameters their values changes no error
// Units      SI
// Threads    pure function

#include <optional>
#include <vector>

#include "engine/diagnose/arms/setup_fit.hpp"

namespace torquescope {

struct SetupNumbers {
  double halves = 0.5;            // of the held-out error of at least one joint
  double worse = 1.15;            // of that of any other
  double tells_nothing = 0.7;     // errors of a joint beyond this are alike: its torque is not explained at all
  double alike = 0.05;            // a joint's logarithm of the error: the simpler of two changes is taken
  double least_error = 0.05;      // a joint that is fitted as well as this has no reason to be asked
  double least_file_error = 0.3;  // the same of the robot file's inertias, which are seldom better
  double file_slack = 0.02;       // a file that is as close to the fit's own error is right
  double least_factor = 1.5;      // of a torque: smaller ones are gains of drives, not units
  double greatest_factor = 1e6;   // milli, and a gear of 1000
  std::size_t most_changes = 3;
  std::size_t beginnings = 5;  // first changes that are followed up
};

struct SetupStep {
  SetupChange change;
  bool is_told_by_file = false;
  Eigen::VectorXd before, after;  // [N] errors of the fit on held-out blocks, or of the robot file's inertias
};

struct SetupSearch {
  std::vector<SetupStep> steps;  // empty: nothing is wrong that a change would mend
  SetupFit fit;                  // of the set-up with all steps
  ArmSetup setup;
};

// no joint's error rises
bool raises_none(Eigen::VectorXd const& before, Eigen::VectorXd const& after, SetupNumbers const& numbers);
// One joint's error after, on held-out blocks, is below half of what the set-up before leaves of the blocks it was
// fitted to (own, above least_error), and no joint's rises. A short recording that fits itself well is no mistake
bool halves_one(Eigen::VectorXd const& before, Eigen::VectorXd const& own, Eigen::VectorXd const& after,
                double least_error, SetupNumbers const& numbers);

// otherwise: the chain of the other Denavit-Hartenberg convention, where the robot file has numbers of either
SetupSearch search_setup(ArmSamples const& samples, SerialChain const& chain,
                         std::optional<SerialChain> const& otherwise = {}, SetupNumbers const& numbers = {});

}  // namespace torquescope
