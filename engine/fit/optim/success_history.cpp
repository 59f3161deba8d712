#include "engine/fit/optim/success_history.hpp"

#include <algorithm>

namespace torquescope {

namespace {

// weighted Lehmer mean of one control
double lehmer_mean(std::span<Success const> successes, double TrialControls::*control) {
  double most = 0.0;
  for (auto const& success : successes) most = std::max(most, success.improvement);
  double squares = 0.0, sum = 0.0;
  for (auto const& success : successes) {
    // shares of the largest: their sum cannot overflow
    double const weight = success.improvement / most;
    double const s = success.controls.*control;
    squares += weight * s * s;
    sum += weight * s;
  }
  return squares / sum;
}

}  // namespace

TrialControls SuccessHistory::draw(RandomStream& random) const {
  std::size_t const r = random.below(static_cast<std::uint32_t>(F_.size()));
  auto controls = draw_round({F_[r], CR_[r]}, random);
  if (CR_[r] == terminal) controls.CR = 0.0;
  return controls;
}

void SuccessHistory::learn(std::span<Success const> successes) {
  if (successes.empty()) return;
  bool const only_zero =
      std::all_of(successes.begin(), successes.end(), [](Success const& s) { return s.controls.CR == 0.0; });
  F_[next_] = lehmer_mean(successes, &TrialControls::F);
  CR_[next_] = CR_[next_] == terminal || only_zero ? terminal : lehmer_mean(successes, &TrialControls::CR);
  next_ = (next_ + 1) % F_.size();
}

std::vector<double> SuccessHistory::numbers() const {
  std::vector<double> all = F_;
  all.insert(all.end(), CR_.begin(), CR_.end());
  all.push_back(static_cast<double>(next_));
  return all;
}

void SuccessHistory::restore(std::span<double const> numbers) {
  TORQUESCOPE_EXPECT(numbers.size() == numbers_of(F_.size()));
  std::copy_n(numbers.begin(), F_.size(), F_.begin());
  std::copy_n(numbers.begin() + static_cast<std::ptrdiff_t>(F_.size()), CR_.size(), CR_.begin());
  next_ = static_cast<std::size_t>(numbers.back());
}

}  // namespace torquescope
