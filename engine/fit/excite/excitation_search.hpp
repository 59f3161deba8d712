#pragma once
// The motion, among Fourier motions within an arm's limits, from which its parameters can best be told.
//
// Fitness    condition: log10 of it; d_optimal: - log det per parameter; angle: minus it; above all of these, by its
//            lack, where the arm comes too near to the table or to itself at one of 64 instants of the shortest period
// Random     addressed by the seed: the same motion on any number of threads
// Errors     Error 78: no motion keeps its distance; no motion tells the parameters apart; those of MotionSpace
// Threads    splits every generation over `threads`; model.rows is called from all of them
// Source     Swevers et al. 1997, doi:10.1109/70.631234

#include <cstdint>

#include "engine/fit/excite/arm_clearance.hpp"
#include "engine/fit/excite/excite_options.hpp"
#include "engine/fit/excite/motion_quality.hpp"
#include "engine/robot/serial_chain.hpp"

namespace torquescope {

struct ExcitingMotion {
  FourierMotion motion;
  MotionQuality usual;  // the median of the first generation: random Fourier motions within the same limits
  MotionQuality best;
  std::int64_t evaluations = 0;
};

ExcitingMotion search_excitation(SerialChain const& chain, RowModel const& model, ExciteOptions const& options,
                                 std::uint64_t seed, int threads);

// noise of each joint: as written, a hundredth of max_torque where every joint has one, else 1
Eigen::VectorXd torque_noise(SerialChain const& chain, ExciteOptions const& options);

}  // namespace torquescope
