#include "engine/diagnose/unseen_refutation.hpp"

#include <algorithm>
#include <cmath>

namespace torquescope {
bool speak_against(UnseenEnergies const& energies) {
  constexpr double quarter = 0.25;
  // how much of the torque that the names add is there: 1 of a right law, 0 of one that has nothing to do with the recording
  double const there = 0.5 * (1.0 + (energies.before - energies.after) / energies.moved);
  if (energies.moved >= enough_moved * energies.before && there < quarter) return true;
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
