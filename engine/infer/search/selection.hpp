#pragma once
// What a search has taken and refused: options, accepted effects, the stages of the models without and with them.
//
// Units      energies in (N m)^2 or N^2, summed over weighted rows; earlier steps are converted by energy_unit
// Threads    plain records, pure functions
// Source     engine/infer/moving_rows/THEORY.md, The search

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/fit/statistics/blocked_cv.hpp"
#include "engine/infer/search/late_torque.hpp"
#include "engine/infer/search/model_stage.hpp"
#include "engine/infer/search/shape_refinement.hpp"

namespace torquescope {

struct SelectionOptions {
  std::vector<Effect const*> candidates{};
  double q = 0.05;
  std::size_t max_effects = 5;
  std::string shape_optimiser = "de";
};

struct AcceptedEffect {
  Effect const* effect = nullptr;
  EffectScan scan{};                    // of the step at which it was accepted
  double q = 1.0;                       // chance over the catalogue, there
  double gain = 0.0;                    // energy of the mismatch it explained there, in the unit of the first step
  double cv_gain = 0.0;                 // the same on blocks it was not fitted to
  std::optional<LateTorque> instead{};  // beside the effects accepted before it; by itself, with none
};

// why a refined candidate was not taken
struct RejectedEffect {
  Effect const* effect = nullptr;
  std::string reason{};
};

struct Selection {
  std::vector<EffectScan> first_scan{};  // before anything was accepted
  std::vector<double> first_q{};         // of each
  std::vector<double> first_cv_gain{};   // of each that was refined, NaN else; energy
  MismatchEnergy first_energy{};
  double first_excess = 0.0;               // of it, or what one candidate explains if that is more; energy
  double energy_unit = 1.0;                // what a unit of energy of the first step is under the weights of the last
  bool is_gate_open = false;               // something is missing
  std::vector<AcceptedEffect> accepted{};  // in the order of the final stage's model
  std::vector<RejectedEffect> rejected{};
  std::shared_ptr<ModelStage const> baseline{};  // without effects
  std::shared_ptr<ModelStage const> final{};     // with all of them; the baseline when there are none
  std::int64_t evaluations = 0;                  // of shapes

  bool has_accepted(Effect const* effect) const;
  double whole() const;  // first_excess under the weights of the last step, above 0
};

inline constexpr double smallest_mismatch_share = 0.0025;  // of the torque's rms
inline constexpr double smallest_omnibus_z = 4.0;

// share of the torque's rms that the mismatch makes up; of any energy
double mismatch_share(ModelStage const& stage);
double energy_share(ModelStage const& stage, double energy);
// of the mismatch, were the twins' mean known: a draft has fewer twins to know it from
double energy_about_true_mean(ModelStage const& stage);
// called before and after every piece of work: "replicates" (how many of how many), "search" and "verify" (effects)
using StageSink = std::function<void(std::string const& stage, std::size_t done, std::size_t total)>;

}  // namespace torquescope
