#pragma once
// Rows of all joints of an arm in the order of time, with the columns of their models and of effects of the whole arm.
//
// Rows       of all samples, as the model of each joint treats them: its delay, samples at rest, sticking
//            (decision/treated_fit.hpp); divided by the noise of their joint; of a recording by instant, then by joint
// Model      columns that the joints share, then those of each joint's own
// Stretches  each recording in twenty of equal length: what is left out, and what may turn its sign, together
// Shapes     n rows, P columns of the model, L of all effects side by side
// Errors     those of the filters
// Threads    free functions

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "engine/diagnose/arms/arm_effects.hpp"
#include "engine/fit/statistics/equal_blocks.hpp"
#include "engine/infer/decision/pooled_rows.hpp"

namespace torquescope {

struct ArmRow {
  std::size_t joint = 0;
  std::size_t recording = 0;
  Eigen::Index instant = 0;
  double time_s = 0.0;  // on the recording's own clock
};

struct ArmStretch {
  std::size_t recording = 0;
  RowBlock rows{};
  double from_s = 0.0, until_s = 0.0;
};

// of an effect: its columns among those of all
struct EffectPlace {
  Effect const* effect = nullptr;
  std::optional<std::size_t> joint{};
  Eigen::Index first = 0, count = 0;
};
std::vector<EffectPlace> effect_places(std::vector<WholeArmEffect> const& effects);
Eigen::Index effect_columns(std::vector<EffectPlace> const& places);

// the grid of rows of one recording; all joints have the same
struct RowGrid {
  Eigen::Index instants = 0;
  double start_s = 0.0, period_s = 0.0;
  double neighbour_correlation = 0.0;  // of white noise that passed the filter
};

// one joint in one or more recordings, one after the other
struct RowsOfJoint {
  std::size_t joint = 0;
  SharedRows model{};
  Eigen::MatrixXd effects{};   // n x L
  std::vector<ArmRow> rows{};  // n
  std::vector<RowGrid> recordings{};
  double torque_energy = 0.0;  // of the filtered torque as it is
};

struct WholeArmRows {
  Eigen::MatrixXd model{}, effects{};  // n x P, n x L
  Eigen::VectorXd torque{};            // n
  std::vector<ArmRow> rows{};          // n
  std::vector<ArmStretch> stretches{};
  std::vector<RowGrid> recordings{};
  std::vector<EffectPlace> places{};
  double torque_energy = 0.0;  // of all joints
};

inline constexpr Eigen::Index stretches_per_recording = 2 * n_folds;
inline constexpr char const* whole_arm_effects_name = "whole_arm_laws";

// the effects' columns at the joints of one recording, for rows_of_joint() to find
void give_whole_arm_effects(std::vector<Recording>& joints, std::vector<WholeArmEffect> const& effects);

// a joint of an arm as a model of its own has it
struct DecidedJoint {
  std::size_t joint = 0;
  JointStrips const& strips;
  FittedModel const& model;
  SharedEffect shared{};
  std::vector<double> begins_s{};  // of each recording on its own clock, those of training first
};
struct ArmRowsOfJoint {
  RowsOfJoint training{};
  std::vector<RowsOfJoint> validation{};  // of each recording
};
// effects: L
ArmRowsOfJoint rows_of_joint(DecidedJoint const& joint, Eigen::Index effects);

// own_columns: of each joint; fewer in recordings that are predicted, whose further ones are zero. noise: [N]
WholeArmRows whole_arm_rows(std::vector<RowsOfJoint const*> const& joints, std::vector<Eigen::Index> const& own_columns,
                            Eigen::VectorXd const& noise, std::vector<EffectPlace> const& places);

}  // namespace torquescope
