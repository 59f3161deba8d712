#pragma once
// What a search found out about one joint: numbers and enums, from which the verdict and every sentence are made.
//
// Errors     ||residual|| / ||torque|| over all rows of the filtered torque, where no sample is set aside; inside the
//            interval of static friction a residual is zero. Those of steps and effects are of weighed rows
// Units      SI; shares are fractions of 1; NaN: not measured
// Threads    plain records
// Source     engine/infer/decision/THEORY.md, Rows

#include <Eigen/Core>
#include <cstddef>
#include <limits>
#include <vector>

#include "engine/infer/decision/replicate_strips.hpp"

namespace torquescope {

enum class Refusal {
  none,
  chance,         // replicates of the model reach such a gain
  smaller,        // beyond chance, but another effect gains more
  too_small,      // its torque is below delta, or judged errors fall by less than least_fall
  at_bound,       // a size beyond what it can be
  not_predicted,  // rows that no fit has seen are not predicted better
};

struct EffectFacts {
  Effect const* effect = nullptr;
  std::vector<double> shape{};
  double gain = 0.0;                                       // D
  double p = 1.0;                                          // chance over the catalogue
  double level = 0.0;                                      // D that a share alpha of the replicates reach
  double size = std::numeric_limits<double>::quiet_NaN();  // of its torque beside the model, over the torque's rms
  // errors on rows that no fit has seen: of other recordings, else in ten folds
  double judged_before = std::numeric_limits<double>::quiet_NaN();
  double judged_after = std::numeric_limits<double>::quiet_NaN();
  Refusal refusal = Refusal::chance;
  std::vector<Effect const*> rivals{};  // that the rows cannot tell from it
};

// smooth functions of one axis of the motion, whatever their form
struct CorrectionFacts {
  SignatureAxis axis = SignatureAxis::position;
  double gain = 0.0, p = 1.0;  // D, and chance among replicates
  double size = 0.0;           // over the torque's rms
};

struct StepFacts {
  std::vector<EffectFacts> effects{};  // largest D first
  std::size_t replicates = 0;
  ReplicateSource source = ReplicateSource::measured_motion;  // of the first recording
  bool is_of_clock = false;
  bool has_taken = false;  // an effect
  double visible = 0.0;    // over the torque's rms: what most effects must be to come out
  double error = 0.0;      // of the model that the step began with, in training
  CorrectionFacts correction{};

  // an effect of this torque: it would not come out, and what the model leaves is large enough to hold it
  bool could_hide(double torque) const { return visible > torque && error > torque; }
};

struct ModelErrors {
  double train = std::numeric_limits<double>::quiet_NaN();
  double held_out = std::numeric_limits<double>::quiet_NaN();  // in ten folds of training
  double validation = std::numeric_limits<double>::quiet_NaN();
  double judged() const { return validation == validation ? validation : held_out; }
};

// of a parameter of the model, by leaving out a tenth of the rows
struct FittedNumber {
  double value = 0.0, deviation = 0.0;
};

struct DelayFacts {
  double late_s = 0.0, deviation_s = 0.0;
  double gain = 0.0;  // D against the same model at an allowed delay
  double p = 1.0;
  double size = 0.0;
  double judged_without = std::numeric_limits<double>::quiet_NaN();
  bool is_named = false;
};

struct DecisionFacts {
  double quiet_share = 0.0;      // of the samples
  double set_aside_share = 0.0;  // of the rows: filled, saturated
  std::vector<StepFacts> steps{};
  std::size_t last_steps = 0;  // so many of the last were asked beside the final model
  bool is_complete = false;    // the final model: decision_verdict.hpp
  std::vector<EffectFacts> accepted{};
  ModelErrors baseline{}, final{};                  // all rows alike
  ModelErrors weighed_baseline{}, weighed_final{};  // of the rows as they are decided on
  double baseline_late_s = 0.0;
  DelayFacts delay{};
  double torque_rms = 0.0;
  double sticking_length = 0.0;  // rad or m: friction that turns round within less belongs to the model
  std::vector<FittedNumber> baseline_parameters{}, parameters{};  // of the model; then of each effect's shapes
};

}  // namespace torquescope
