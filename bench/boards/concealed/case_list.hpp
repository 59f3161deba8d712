#pragma once
// The sealed cases, and a generator of clean ones.
//
// Names are neutral: a job, its folder and its recordings say nothing about what is concealed.
//
// Errors     sealed_case: std::invalid_argument for an unknown name

#include <cstdint>
#include <string>
#include <vector>

#include "concealed/closed_loop.hpp"
#include "concealed/concealed_effects.hpp"

namespace concealed {

// filters a careful user would choose for a 1 kHz recording of these joints; the same for every case
inline constexpr double position_cutoff_hz = 60.0, parallel_cutoff_hz = 30.0, decimate_to_hz = 100.0;

struct Case {
  std::string name;
  Rig rig;
  Recipe train = Recipe::mixed, validate = Recipe::multisine;
  double train_s = 60.0, validate_s = 30.0;
  std::vector<ConcealedEffect> effects;
  std::uint64_t seed = 0;
  // of drawn cases only
  std::string tier, drawn;  // "T1", its name
  std::string expected;
  double wanted_snr = 0.0;  // of each effect alone
  int plant_draws = 1;      // until its plant was exact

  HiddenEffects laws() const;
  // "none", "named", "unexplained"; drawn cases also "insufficient" (or a class), "measurement" (nothing mechanical)
  std::string expected_verdict() const;
  Excitation excitation(bool for_training) const;
  RunPlan plan(Excitation const& excitation, bool for_training) const;
};

Rig with_faults(Rig rig, std::vector<ConcealedEffect> const& effects);
// the training motion on this rig, with these effects and no others
LoopRun training_run(Case const& one_case, Rig const& rig, std::vector<ConcealedEffect> const& effects, double step_s);

std::vector<Case> const& sealed_cases();
Case const& sealed_case(std::string const& name);

// joint, friction, loop, noise, encoder and motions follow from the seed; nothing is concealed. sticking: of
// sticking_law.hpp, the same for all seeds
Case clean_case(std::uint64_t seed, std::string const& sticking = "coulomb");

}  // namespace concealed
