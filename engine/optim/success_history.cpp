#include "engine/optim/success_history.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace torquescope {

namespace {

constexpr double spread = 0.1;

double cauchy(RandomStream& random, double centre) {
  double const u = RandomStream::probability(random.bits());
  return centre + spread * std::tan(std::numbers::pi * (u - 0.5));
}

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
  double const deviate = random.normal();
  TrialControls controls;
  controls.CR = CR_[r] == terminal ? 0.0 : std::clamp(CR_[r] + spread * deviate, 0.0, 1.0);
  do controls.F = std::min(cauchy(random, F_[r]), 1.0);
  while (!(controls.F > 0.0));
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
