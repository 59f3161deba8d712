#pragma once
// Whether a model with names predicts held-out rows clearly better than the baseline: a one-sided paired test.
//
// Equation   of every block b. alike: d_b = sqrt(before_b / rows_b) - sqrt(after_b / rows_b);  t = mean(d) / error(d).
//            where_it_acts: g_b = (before_b - after_b) / s_b, e_b = changed_b / s_b, s_b = min(before_b, after_b);
//            ratio = sum(g) / sum(e);  t = ratio / error(ratio) from g_b - ratio e_b;  degrees of freedom
//            sum(e)^2 / sum(e^2) - 1
//            lower: the energy over all blocks falls, and t is above the 95 % quantile of Student's t
// Which      alike asks whether a gain holds all over the recording, which replicates of a model that is not adequate
//            cannot say; beside an adequate model an effect that acts in few blocks is judged by these
// Error      Newey, West 1987 (Bartlett weights, cube root of the blocks as lags), at least that of independent blocks
// Shapes     blocks in time order, recordings one after another; each at least as long as the filter remembers
// Undecided  fewer than eight blocks, or numbers that are none
// Threads    pure function
// Source     Diebold, Mariano 1995, doi:10.1080/07350015.1995.10524599; ratio estimator: Cochran 1977, section 6.3,
//            ISBN 978-0-471-16240-7

#include <Eigen/Core>
#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace torquescope {

// energies of the residuals on one stretch of held-out rows
struct HeldOutBlock {
  double before = 0.0, after = 0.0;
  double changed = 0.0;  // of the difference of both
  double rows = 0.0;
};

enum class HeldOutChange { lower, not_lower, undecided };
std::string word(HeldOutChange change);  // "not lower"

struct HeldOutGain {
  HeldOutChange change = HeldOutChange::undecided;
  double before = 0.0, after = 0.0;                             // energies, over all blocks
  double t = std::numeric_limits<double>::quiet_NaN();          // above 0: the error falls
  double asked_for = std::numeric_limits<double>::quiet_NaN();  // of t
  std::size_t blocks = 0;

  // the error does not rise by more than chance
  bool is_not_worse() const { return change != HeldOutChange::undecided && t > -asked_for; }
};

enum class Blocks { alike, where_it_acts };

HeldOutGain held_out_gain(std::span<HeldOutBlock const> blocks, Blocks which = Blocks::alike);

// of the residuals of one recording, one per row: at least `memory` rows in a block, 60 blocks at most and 8 at least
std::vector<HeldOutBlock> held_out_blocks(Eigen::VectorXd const& left_before, Eigen::VectorXd const& left_after,
                                          Eigen::Index memory);

}  // namespace torquescope
