#include "engine/statistics/held_out_gain.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/base/contract.hpp"
#include "engine/statistics/equal_blocks.hpp"
#include "engine/statistics/student_t.hpp"

namespace torquescope {
namespace {

constexpr std::size_t fewest_blocks = 8;  // of which a spread can be told, and the quantile is right to 1e-3

// variance of the mean of numbers that follow one another
double variance_of_mean(std::vector<double> const& values, double mean) {
  auto const n = static_cast<double>(values.size());
  auto const product = [&](std::size_t lag) {
    double sum = 0.0;
    for (std::size_t i = lag; i < values.size(); ++i) sum += (values[i] - mean) * (values[i - lag] - mean);
    return sum;
  };
  double const own = product(0);
  auto const lags = static_cast<std::size_t>(std::cbrt(n));
  double sum = own;
  for (std::size_t lag = 1; lag <= lags; ++lag)
    sum += 2.0 * (1.0 - static_cast<double>(lag) / static_cast<double>(lags + 1)) * product(lag);
  return std::max(sum, own) / (n * (n - 1.0));
}

}  // namespace

std::string word(HeldOutChange change) {
  switch (change) {
    case HeldOutChange::lower:
      return "lower";
    case HeldOutChange::not_lower:
      return "not lower";
    case HeldOutChange::undecided:
      return "undecided";
  }
  return {};
}

HeldOutGain held_out_gain(std::span<HeldOutBlock const> blocks) {
  HeldOutGain gain;
  std::vector<double> differences;
  for (HeldOutBlock const& block : blocks) {
    if (!(block.rows > 0.0)) continue;
    gain.before += block.before;
    gain.after += block.after;
    differences.push_back(std::sqrt(block.before / block.rows) - std::sqrt(block.after / block.rows));
  }
  gain.blocks = differences.size();
  if (gain.blocks < fewest_blocks || !std::isfinite(gain.before) || !std::isfinite(gain.after)) return gain;
  auto const n = static_cast<double>(gain.blocks);
  double mean = 0.0;
  for (double const difference : differences) mean += difference / n;
  double const error = std::sqrt(variance_of_mean(differences, mean));
  gain.t = error > 0.0 ? mean / error : 0.0;
  gain.asked_for = student_t_quantile(normal_quantile_95, n - 1.0);
  bool const is_lower = gain.after < gain.before && gain.t > gain.asked_for;
  gain.change = is_lower ? HeldOutChange::lower : HeldOutChange::not_lower;
  return gain;
}

std::vector<HeldOutBlock> held_out_blocks(Eigen::VectorXd const& left_before, Eigen::VectorXd const& left_after,
                                          Eigen::Index memory) {
  TORQUESCOPE_EXPECT(left_before.size() == left_after.size() && memory > 0);
  constexpr Eigen::Index most = 60;
  auto const fewest = static_cast<Eigen::Index>(fewest_blocks);
  std::vector<HeldOutBlock> blocks;
  for (auto const& block : equal_blocks(left_before.size(), std::clamp(left_before.size() / memory, fewest, most)))
    blocks.push_back({left_before.segment(block.from, block.size()).squaredNorm(),
                      left_after.segment(block.from, block.size()).squaredNorm(), static_cast<double>(block.size())});
  return blocks;
}

}  // namespace torquescope
