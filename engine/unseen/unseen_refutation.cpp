#include "engine/unseen/unseen_refutation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/statistics/equal_blocks.hpp"

namespace torquescope {
namespace {

struct ShareFound {
  double share = 0.0, error = std::numeric_limits<double>::infinity();
};

ShareFound share_found(UnseenEnergies const& energies) {
  ShareFound result{energies.found.share()};
  double energy = 0.0, squares = 0.0;
  for (auto const& block : energies.blocks) {
    energy += block.energy;
    squares += std::pow(block.found - result.share * block.energy, 2);
  }
  auto const n = static_cast<double>(energies.blocks.size());
  if (n > 1.0 && energy > 0.0) result.error = std::sqrt(squares * n / (n - 1.0)) / energy;
  return result;
}

constexpr double quarter = 0.25;

// of what twins promise, which must be worth it, less than this share is kept
bool breaks_promise(UnseenEnergies const& energies, double share) {
  double const before = energies.found.before;
  if (!std::isfinite(energies.floor)) return false;  // nobody knows
  double const promised = before - energies.floor;
  return promised >= quarter * before && energies.found.gain() < share * promised;
}

}  // namespace

std::vector<AddedTorque> added_torque(Eigen::VectorXd const& left_before, Eigen::VectorXd const& left_after) {
  constexpr Eigen::Index n_blocks = 20;
  std::vector<AddedTorque> blocks;
  for (auto const& block : equal_blocks(left_before.size(), n_blocks)) {
    Eigen::VectorXd const left = left_before.segment(block.from, block.size());
    Eigen::VectorXd const added = left - left_after.segment(block.from, block.size());
    blocks.push_back({added.squaredNorm(), added.dot(left)});
  }
  return blocks;
}

double least_by_chance(std::vector<PredictionEnergies> const& twins) {
  double sum = 0.0, squares = 0.0, n = 0.0;
  for (auto const& twin : twins) {
    if (!(twin.moved > 0.0)) continue;
    double const share = twin.share();
    sum += share;
    squares += share * share;
    ++n;
  }
  if (n < 2.0) return std::numeric_limits<double>::infinity();
  double const mean = sum / n;
  return mean - 3.0 * std::sqrt(std::max(0.0, squares / n - mean * mean) * n / (n - 1.0));
}

std::vector<PredictionEnergies> over_recordings(std::vector<std::vector<PredictionEnergies>> const& twins) {
  if (twins.empty()) return {};
  std::vector<PredictionEnergies> sum = twins.front();
  for (std::size_t i = 1; i < twins.size(); ++i) {
    if (twins[i].size() != sum.size()) return {};
    for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += twins[i][k];
  }
  return sum;
}

bool speak_against(UnseenEnergies const& energies) {
  auto const& [before, after, moved] = energies.found;
  ShareFound const there = share_found(energies);
  if (there.share >= least_by_chance(energies.twins)) return false;
  constexpr double sure = 2.0;  // standard errors
  bool const is_short =
      (moved >= enough_moved * before && there.share < quarter) || there.share + sure * there.error < quarter;
  if (is_short) return true;
  if (!std::isfinite(energies.floor)) return after > before && moved >= quarter * before;
  return moved >= quarter * before && breaks_promise(energies, quarter);
}

bool speak_against_a_part(UnseenEnergies const& energies) {
  constexpr double half = 0.5;
  return speak_against(energies) || breaks_promise(energies, half);
}

}  // namespace torquescope
