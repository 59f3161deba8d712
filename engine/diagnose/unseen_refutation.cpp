#include "engine/diagnose/unseen_refutation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace torquescope {
namespace {

// how much of the torque that the names add is there: 1 of a right law, 0 of one that has nothing to do with the recording
struct ShareFound {
  double share = 0.0, error = std::numeric_limits<double>::infinity();
};

ShareFound share_found(UnseenEnergies const& energies) {
  ShareFound result{0.5 * (1.0 + (energies.before - energies.after) / energies.moved)};
  double energy = 0.0, squares = 0.0;
  for (auto const& block : energies.blocks) {
    energy += block.energy;
    squares += std::pow(block.found - result.share * block.energy, 2);
  }
  auto const n = static_cast<double>(energies.blocks.size());
  if (n > 1.0 && energy > 0.0) result.error = std::sqrt(squares * n / (n - 1.0)) / energy;
  return result;
}

}  // namespace

std::vector<AddedTorque> added_torque(Eigen::VectorXd const& left_before, Eigen::VectorXd const& left_after) {
  constexpr Eigen::Index n_blocks = 20;
  std::vector<AddedTorque> blocks;
  for (Eigen::Index block = 0; block < n_blocks; ++block) {
    Eigen::Index const from = left_before.size() * block / n_blocks, to = left_before.size() * (block + 1) / n_blocks;
    Eigen::VectorXd const left = left_before.segment(from, to - from);
    Eigen::VectorXd const added = left - left_after.segment(from, to - from);
    blocks.push_back({added.squaredNorm(), added.dot(left)});
  }
  return blocks;
}

bool speak_against(UnseenEnergies const& energies) {
  constexpr double quarter = 0.25;
  ShareFound const there = share_found(energies);
  if (energies.moved >= enough_moved * energies.before && there.share < quarter) return true;
  constexpr double sure = 2.0;  // standard errors
  if (there.share + sure * there.error < quarter) return true;
  if (!std::isfinite(energies.floor))
    return energies.after > energies.before && energies.moved >= quarter * energies.before;
  double const enough = quarter * energies.before, promised = energies.before - energies.floor;
  bool const is_kept = energies.before - energies.after >= quarter * promised;
  return !is_kept && promised >= enough && energies.moved >= enough;
}

// not what is of the very recording: its clock, its zero
bool must_carry_over(Effect const& effect) {
  auto const& families = effect.families();
  return !effect.is_event() && std::find(families.begin(), families.end(), EffectFamily::time) == families.end();
}

bool must_carry_over(std::vector<AcceptedEffect> const& accepted) {
  return !accepted.empty() &&
         std::all_of(accepted.begin(), accepted.end(), [](auto const& one) { return must_carry_over(*one.effect); });
}

}  // namespace torquescope
