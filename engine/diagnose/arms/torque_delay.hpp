#pragma once
// How late the torque of each joint of an arm is beside its motion: what the channel of a drive may do, and no physics.
//
// Equation   tau_j(t + lag) = y_j(t) chi + friction_j, all joints in one fit, each weighed by its own residual. Blocks
//            of time are fitted and held out in turn
// Taken      one joint after the other, the one first whose lag explains most; where it leaves of that joint's
//            held-out blocks half of what the fit without it leaves of its own, and no other joint's error grows.
//            Between lags of the grid: where a parabola is least
// Not told   up to 1.5 samples, as in every log; lags beyond 60 ms
// Shapes     of each joint and side a gram of [its columns, torque at each lag]
// Units      s; positive: the torque comes late
// Threads    adding from one thread; the search is a pure function

#include <Eigen/Core>
#include <array>
#include <vector>

#include "engine/data/motion.hpp"
#include "engine/fit/problem/arm_model.hpp"
#include "engine/fit/problem/recorded_rows.hpp"

namespace torquescope {

struct LaggedGrams {
  std::vector<Eigen::Index> lags{};  // samples, ascending, 0 in the middle
  double rate_hz = 0.0;
  std::vector<std::vector<Eigen::Index>> parameters{};    // [N] as ArmModel::parameters_of
  std::vector<std::array<Eigen::MatrixXd, 2>> of_side{};  // [N], of every other block of time
  Eigen::Index unknowns = 0;

  // moving rows of one recording; recordings of another rate than the first's add nothing
  void add(ArmModel const& model, std::vector<Motion> const& motion, RecordedRows const& rows,
           ParallelFilter const& filter);
};

struct TorqueDelayNumbers {
  double halves = 0.5;         // the energy that is left of the joint
  double worse = 1.05;         // of any other joint's
  double least_samples = 1.5;  // up to a sample is how drives write; half of one more is what the lag errs by
};

struct TorqueDelay {
  std::size_t joint = 0;
  double seconds = 0.0;
  double before = 0.0, after = 0.0;  // relerr of the joint on held-out blocks
};

// in the order of joints; empty: none is late
std::vector<TorqueDelay> find_torque_delays(LaggedGrams const& grams, TorqueDelayNumbers const& numbers = {});

}  // namespace torquescope
