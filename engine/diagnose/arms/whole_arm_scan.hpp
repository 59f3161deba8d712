#pragma once
// What every effect of the whole arm gains on rows left out, in every window of time it may act in, and what chance
// gains.
//
// Gain       fall of the energy left out (left_out.hpp): stretches of a recording are dealt to ten folds in turn, so
//            that an effect that acts in a part is fitted on the rest of it
// Window     an effect with instants acts in two or more stretches of one recording that follow each other
// Null       what the model leaves, each stretch with a random sign that all joints share (dependent wild bootstrap:
//            Shao 2010, doi:10.1198/jasa.2009.tm08744); z of each candidate by its own, p of the largest over all
//            (max-T: Westfall, Young 1993, ISBN 978-0-471-55761-6)
// Bits       the same for any number of threads
// Threads    spreads candidates over `threads`

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "engine/diagnose/arms/whole_arm_rows.hpp"
#include "engine/fit/statistics/left_out.hpp"

namespace torquescope {

// stretches from .. to - 1 of WholeArmRows::stretches
struct StretchWindow {
  std::size_t from = 0, to = 0;
};

struct ScannedEffect {
  std::size_t effect = 0;                 // of WholeArmRows::places
  std::optional<StretchWindow> window{};  // none: everywhere
  double gain = 0.0, z = 0.0, p = 1.0;
};

struct ScanSetting {
  std::uint64_t seed = 0;
  std::uint32_t step = 0;  // of the search: each draws signs of its own
  int threads = 1;
};

// of each effect its best window, in the order of rows.places; effects that the basis explains are left out.
// basis: n x k orthonormal, residual: n, what it leaves
std::vector<ScannedEffect> scan_whole_arm_effects(WholeArmRows const& rows, Eigen::MatrixXd const& basis,
                                                  Eigen::VectorXd const& residual, ScanSetting const& setting);

// the stretches of each fold
std::vector<Fold> folds_of_stretches(WholeArmRows const& rows);

}  // namespace torquescope
