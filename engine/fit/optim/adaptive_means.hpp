#pragma once
// The two means round which JADE draws each trial's controls, and how they follow what succeeded.
//
// Equation   mu_CR <- (1 - c) mu_CR + c mean(S_CR);  mu_F <- (1 - c) mu_F + c sum(S_F^2) / sum(S_F), S the controls of
//            a generation's successes; both begin at 0.5
// Source     Zhang, Sanderson: JADE, IEEE TEC 13 (2009), eq. 10-13, doi:10.1109/TEVC.2009.2014613

#include <span>
#include <vector>

#include "engine/fit/optim/trial_controls.hpp"

namespace torquescope {

class AdaptiveMeans {
 public:
  // learning_rate: c, 0 .. 1
  explicit AdaptiveMeans(double learning_rate) : learning_rate_(learning_rate) {}

  TrialControls draw(RandomStream& random) const { return draw_round(means_, random); }
  // of one generation; none changes nothing
  void learn(std::span<TrialControls const> successes);

  TrialControls const& means() const { return means_; }

  // mu_F, mu_CR
  std::vector<double> numbers() const { return {means_.F, means_.CR}; }
  void restore(std::span<double const> numbers) { means_ = {numbers[0], numbers[1]}; }

 private:
  double learning_rate_;
  TrialControls means_{0.5, 0.5};
};

}  // namespace torquescope
