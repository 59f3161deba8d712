#pragma once
// What F and CR succeeded with: the memory from which L-SHADE draws each trial's controls.
//
// Equation   F, CR round M_F,r, M_CR,r (trial_controls.hpp), r uniform. After a generation with successes the next
//            entry, in turn, becomes their weighted Lehmer means
//              mean(S) = sum w s^2 / sum w s,  w = f(x) - f(u) of the success, over its sum
//            An entry whose successes all had CR = 0 is terminal: CR = 0 from then on, and it stays terminal
// Random     one draw for r, one for CR, one or more for F
// Source     Tanabe, Fukunaga: Improving the search performance of SHADE using linear population size reduction, CEC
//            2014, eq. 1-7 and algorithm 1

#include <cstddef>
#include <span>
#include <vector>

#include "engine/fit/optim/trial_controls.hpp"

namespace torquescope {

struct Success {
  TrialControls controls;
  double improvement = 0.0;  // finite, above 0
};

class SuccessHistory {
 public:
  static constexpr double terminal = -1.0;

  explicit SuccessHistory(std::size_t n_entries) : F_(n_entries, 0.5), CR_(n_entries, 0.5) {}

  TrialControls draw(RandomStream& random) const;
  // of one generation; none changes nothing
  void learn(std::span<Success const> successes);

  std::vector<double> const& F() const { return F_; }
  std::vector<double> const& CR() const { return CR_; }  // `terminal` where nothing else is drawn

  // F, CR and the place of the next entry
  std::vector<double> numbers() const;
  static std::size_t numbers_of(std::size_t n_entries) { return 2 * n_entries + 1; }
  void restore(std::span<double const> numbers);

 private:
  std::vector<double> F_, CR_;
  std::size_t next_ = 0;
};

}  // namespace torquescope
