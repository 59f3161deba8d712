#pragma once
// What a model leaves on rows that it was not fitted to, and whether another one leaves clearly less there.
//
// Blocks     as long as the filter's memory; tests are paired, one-sided, level 5 % (held_out_gain.hpp)
// Threads    free functions
// Source     engine/infer/moving_rows/THEORY.md, Confidence set; Diebold, Mariano 1995,
//            doi:10.1080/07350015.1995.10524599

#include <Eigen/Core>
#include <vector>

namespace torquescope {

// of the recording: training first, then unseen recordings; whitened
struct RowsLeft {
  struct Part {
    Eigen::VectorXd left{};
    Eigen::Index memory_rows = 1;
  };
  std::vector<Part> parts{};
  double energy() const;
};

// whether `other` leaves clearly less than `one`
bool leaves_clearly_less(RowsLeft const& other, RowsLeft const& one);
// whether a law leaves clearly more than the best where they differ, and by more than the form of a law may be off:
// tolerance, a share of the torque that the best explains of what is left without any
struct OfForm {
  RowsLeft const& without_any;
  double tolerance;
};
bool leaves_clearly_more(RowsLeft const& one, RowsLeft const& best, OfForm const& form);

}  // namespace torquescope
