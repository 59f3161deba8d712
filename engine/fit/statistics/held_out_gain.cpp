#include "engine/fit/statistics/held_out_gain.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/base/contract.hpp"
#include "engine/fit/statistics/equal_blocks.hpp"
#include "engine/fit/statistics/student_t.hpp"

namespace torquescope {
namespace {

constexpr std::size_t fewest_blocks = 8;  // of which a spread can be told, and the quantile is right to 1e-3

// variance of the sum of numbers about 0 that follow one another
double variance_of_sum(std::vector<double> const& values) {
  auto const n = static_cast<double>(values.size());
  auto const product = [&](std::size_t lag) {
    double sum = 0.0;
    for (std::size_t i = lag; i < values.size(); ++i) sum += values[i] * values[i - lag];
    return sum;
  };
  double const own = product(0);
  auto const lags = static_cast<std::size_t>(std::cbrt(n));
  double sum = own;
  for (std::size_t lag = 1; lag <= lags; ++lag)
    sum += 2.0 * (1.0 - static_cast<double>(lag) / static_cast<double>(lags + 1)) * product(lag);
  return std::max(sum, own) * n / (n - 1.0);
}

// mean of d over its error
void judge_alike(std::vector<HeldOutBlock> const& blocks, HeldOutGain& gain) {
  auto const n = static_cast<double>(blocks.size());
  std::vector<double> falls;
  double sum = 0.0;
  for (HeldOutBlock const& block : blocks) {
    falls.push_back(std::sqrt(block.before / block.rows) - std::sqrt(block.after / block.rows));
    sum += falls.back();
  }
  for (double& fall : falls) fall -= sum / n;
  double const error = std::sqrt(variance_of_sum(falls));
  gain.t = error > 0.0 ? sum / error : 0.0;
  gain.asked_for = student_t_quantile(normal_quantile_95, n - 1.0);
}

// in units of what the better model leaves of a block: a loud one decides nothing
void judge_where_it_acts(std::vector<HeldOutBlock> const& blocks, HeldOutGain& gain) {
  std::vector<double> falls, changes;
  double fallen = 0.0, changed = 0.0, squares = 0.0;
  for (HeldOutBlock const& block : blocks) {
    double const level = std::min(block.before, block.after);
    falls.push_back(level > 0.0 ? (block.before - block.after) / level : 0.0);
    changes.push_back(level > 0.0 ? block.changed / level : 0.0);
    fallen += falls.back();
    changed += changes.back();
    squares += changes.back() * changes.back();
  }
  double const ratio = changed > 0.0 ? fallen / changed : 0.0;
  for (std::size_t i = 0; i < falls.size(); ++i) falls[i] -= ratio * changes[i];
  double const error = std::sqrt(variance_of_sum(falls));
  gain.t = error > 0.0 ? fallen / error : 0.0;
  double const acting = squares > 0.0 ? changed * changed / squares : static_cast<double>(blocks.size());
  gain.asked_for = student_t_quantile(normal_quantile_95, std::max(1.0, acting - 1.0));
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

HeldOutGain held_out_gain(std::span<HeldOutBlock const> blocks, Blocks which) {
  HeldOutGain gain;
  std::vector<HeldOutBlock> with_rows;
  for (HeldOutBlock const& block : blocks) {
    if (!(block.rows > 0.0)) continue;
    with_rows.push_back(block);
    gain.before += block.before;
    gain.after += block.after;
  }
  gain.blocks = with_rows.size();
  if (gain.blocks < fewest_blocks || !std::isfinite(gain.before) || !std::isfinite(gain.after)) return gain;
  which == Blocks::alike ? judge_alike(with_rows, gain) : judge_where_it_acts(with_rows, gain);
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
  for (auto const& block : equal_blocks(left_before.size(), std::clamp(left_before.size() / memory, fewest, most))) {
    auto const before = left_before.segment(block.from, block.size()),
               after = left_after.segment(block.from, block.size());
    blocks.push_back(
        {before.squaredNorm(), after.squaredNorm(), (before - after).squaredNorm(), static_cast<double>(block.size())});
  }
  return blocks;
}

}  // namespace torquescope
