#pragma once
// What a diagnosis found about one joint: everything the verdict, the page and the result file are written from.
//
// Units      SI of the joint's kind; each parameter and axis names its unit. Shares are fractions of 1
// Unknown    NaN: not measured (no validation recording, no repeated laps, no reference to simulate with)
// relerr     ||tau - tau_hat|| / ||tau|| on the filtered rows of all samples
// Threads    plain records
// Source     decision/THEORY.md, Adequacy; as JSON: workflows/results/diagnosis_json.hpp; as HDF5:
//            store/RESULT_FORMAT.md

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/data/finding.hpp"
#include "engine/infer/verdict/decision_account.hpp"

namespace torquescope {

inline constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

enum class Verdict { none, named, one_of_class, partly, unexplained, insufficient, data_fault };
std::string word(Verdict verdict);  // "class" for one_of_class
// whether accepted effects stand as missing physics, all of it or a part
bool names_physics(Verdict verdict);

struct ParameterEstimate {
  std::string name;
  std::string unit;
  double value = unknown;
  double lower = unknown, upper = unknown;  // 95 %
};

// an interval of one axis; `axis` is a word of SignatureAxis
struct AxisInterval {
  std::string axis;
  double from = unknown, to = unknown;
  std::string unit;
};

// a located region: where the recording's residual is not what replicates have
struct MismatchRegion {
  AxisInterval where;
  double time_share = unknown;
  double energy_share = unknown;      // of the residual's energy, baseline fitted
  double repeatable_share = unknown;  // of the region's own energy: what replicates never show
};

struct MapCell {
  double from = 0.0, to = 0.0;
  Eigen::Index samples = 0;     // rows
  double mean_residual = 0.0;   // torque; of a spectrum: amplitude
  double replicate_mean = 0.0;  // the same of the replicates, averaged
  double replicate_std = 0.0;   // spread of one replicate's mean residual
  double z = 0.0;               // (mean_residual - replicate_mean) over its spread; of a spectrum: of the log power
  double after_z = unknown;     // the same with the accepted effects in the model
  double after_residual = unknown;
  double torque_share = unknown;  // of a spectrum: of the torque's own energy about its mean; not stored
};

// one row of the mismatch map
struct MapAxis {
  std::string axis;  // word of SignatureAxis
  std::string unit;
  bool is_spectrum = false;  // frequency, order: one-sided, cells hold power
  std::vector<MapCell> cells{};
  double energy_share = 0.0;  // of the residual, beyond what the replicates have on this axis
  double p = 1.0;             // of that share, from the replicates
  std::vector<MismatchRegion> regions{};
};

enum class Decision { named, equivalent, measurement, rejected, not_tested };
std::string word(Decision decision);  // "named", "class", "measurement", "no", "not tested"

// one line of the candidate table, at the first step
struct Candidate {
  std::string name;
  std::string family;
  double z = 0.0, p = 1.0, q = 1.0;
  double gain = 0.0;  // share of the mismatch (residual beyond the replicates) it explains, at its best shape
  double cv_gain =
      unknown;  // of the mismatch on blocks of time that nothing was fitted to; below 0 where it makes them worse
  Decision decision = Decision::rejected;
  std::string reason{};  // one clause: why this decision; "" for accepted effects
};

struct EffectGain {
  // shares of the energy that the baseline leaves there: on the rows, on blocks of them that it was not fitted to
  double train = unknown, cv = unknown;
};

// a curve to draw: the effect against its principal axis
struct EffectCurve {
  AxisInterval axis{};             // whole range drawn
  std::vector<double> at{};        // cell centres
  std::vector<double> partial{};   // mean of effect + what is left
  std::vector<double> modelled{};  // mean of the effect
  std::vector<double> spread{};    // of one replicate's mean
};

struct NamedEffect {
  std::string name;
  std::string family;
  std::string title;  // of the effect, for people
  std::string equation;
  std::string acts_on;                    // word of ActsOn
  std::vector<std::string> equivalent{};  // effects that fit as well
  double p = 1.0, q = 1.0, z = 0.0;       // at the step at which it was accepted
  EffectGain gain{};
  AxisInterval region{};               // where it acts, as one interval (acting_region.hpp)
  std::vector<AxisInterval> places{};  // the same as one or two
  double rms = unknown,
         peak = unknown;  // torque beside the model's own terms; peak: where it acts (effect_account.hpp)
  std::vector<ParameterEstimate> parameters{};
  std::string sentence{};
  EffectCurve curve{};
};

class Effect;
// what the catalogue says of it, nothing found yet
NamedEffect named_after(Effect const& effect);

// a delay of the torque that is negative
bool comes_before_motion(NamedEffect const& effect);

// Of a recorded channel, not physics of the joint; nor may any effect that cannot be excluded be physics. A torque that
// comes before its motion may be a command that the drive follows late
bool is_fault(NamedEffect const& effect);

struct Budget {  // shares of the baseline residual's energy, sum 1
  double parameter_error = 0.0, missing_physics = 0.0, unexplained = 0.0, noise = 1.0;
};

struct UnexplainedPart {
  AxisInterval where;
  double energy_share = unknown;
};

struct ExcitationAdvice {
  std::string lacks;
  std::vector<std::string> would_separate{};
};

// torque of a stretch of a recording, for the trace on the page; rows are evenly spaced, masked rows hold NaN residuals
struct TorqueTrace {
  std::string recording;
  double rate_hz = 0.0;
  Eigen::VectorXd time_s, torque, before, after;  // before, after: residuals
  Eigen::VectorXd velocity, position;
};

// closed loop from the recording's reference, without noise: rms of position minus measured position, rad or m
struct ForwardSimulation {
  std::string recording;
  double before_rms = unknown, after_rms = unknown;
  double motion_rms = unknown;  // of the measured position about its mean
  double encoder_step = 0.0;
};

// what effects took from the fitted baseline (JointScales); of results before 27 Nov 2026 unknown
struct EffectLevels {
  double forward = unknown, backward = unknown;  // friction_sign() of either direction
  double inertia = unknown;
};

struct JointDiagnosis {
  int joint = 1;
  Verdict verdict = Verdict::none;         // of this joint; of an arm, where each has its own
  std::string reason{};                    // of an arm: one sentence about this joint
  std::string name{};                      // of its position column; "": the joint's number stands for it
  std::string unit_position, unit_torque;  // "rad", "N m"
  std::vector<ParameterEstimate> baseline{};
  double train_relerr = unknown, validation_relerr = unknown, cv_relerr = unknown;
  std::vector<MapAxis> map{};
  std::vector<Candidate> candidates{};  // strongest first
  std::vector<NamedEffect> effects{};   // in the order of acceptance
  std::vector<ParameterEstimate> augmented{};
  EffectLevels effect_levels{};
  double augmented_train_relerr = unknown, augmented_validation_relerr = unknown, augmented_cv_relerr = unknown;
  double validation_torque_energy = unknown;  // of the rows that validation_relerr is of
  double explained_share = unknown;  // of the mismatch's energy on held-out rows, what the accepted effects explain
  Budget budget{};
  std::vector<UnexplainedPart> unexplained{};
  std::string other_joints{};  // that what is left goes with their motion: a sentence of the reason, not stored
  std::vector<ExcitationAdvice> excitation{};
  std::vector<std::string> nuisances{};  // what was refitted on the first 5 % of a validation recording
  std::vector<TorqueTrace> traces{};     // the validation recordings, else the training ones
  std::vector<ForwardSimulation> forward{};
  // how it was found
  std::vector<std::string> remarks{};  // what the motion closed or merged: sentences, in the reason, not stored
  std::string timing_sentence{};       // what was done to the torque channel's time; in the reason
  std::size_t replicates = 0;
  double omnibus_p = 1.0;                     // of the whole mismatch, at the first step
  double mismatch_rms = 0.0;                  // torque beyond the replicates
  double left_rms = 0.0;                      // the same with the accepted effects in the model
  std::vector<double> replicate_energy{};     // residual energy of each replicate over that of the recording
  std::optional<DecisionAccount> decision{};  // what it was decided from
  std::string power_sentence{};               // none: what would have been named (power_words.hpp); "" unknown
};

// the smallest p that counting this many replicates can give: none reached the recording's value; 0 without replicates
inline double least_p(std::size_t replicates) {
  return replicates > 0 ? 1.0 / static_cast<double>(replicates + 1) : 0.0;
}

// "joint 1", or "the joint of q5_rad" where its position column is known
std::string which_joint(JointDiagnosis const& joint);

// of an arm: effects that act on several joints at once
struct WholeArmDiagnosis {
  std::vector<NamedEffect> effects{};   // in the order of acceptance
  std::vector<Candidate> candidates{};  // strongest first
};

struct Diagnosis {
  Verdict verdict = Verdict::none;
  std::string reason;     // one sentence for a person
  std::string finding{};  // data_fault, insufficient: what is wrong with the recording, a clause without full stop
  std::string way_out{};  // data_fault, insufficient: what to do
  std::vector<Finding> findings{};  // of the examination of the recordings
  std::vector<JointDiagnosis> joints{};
  std::optional<WholeArmDiagnosis> arm{};  // none: of one joint
  std::uint64_t seed = 0;
  double q = 0.05;
};

// of an arm, from those of its joints and the effects of the whole: a name counts as the whole answer only where no
// joint is left with a riddle
Verdict verdict_of_arm(std::vector<JointDiagnosis> const& joints, std::vector<NamedEffect> const& of_the_arm = {});

}  // namespace torquescope
