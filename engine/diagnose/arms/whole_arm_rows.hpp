#pragma once
// Rows of all joints of an arm in the order of time, with the columns of its model and of laws of the whole arm.
//
// Rows       of the fit (rigid_rows.hpp): every joint where it moves one way, divided by its noise; of a recording by
//            instant, then by joint
// Stretches  each recording in twenty of equal length: what is left out, and what may turn its sign, together
// Shapes     n rows, R columns of the model, L of all laws side by side
// Errors     those of the filters
// Threads    free functions

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "engine/diagnose/arms/arm_laws.hpp"
#include "engine/diagnose/arms/filtered_arm.hpp"
#include "engine/fit/statistics/equal_blocks.hpp"

namespace torquescope {

struct ArmRow {
  std::size_t joint = 0;
  Eigen::Index instant = 0;
  double time_s = 0.0;
};

struct ArmStretch {
  std::size_t recording = 0;
  RowBlock rows{};
  double from_s = 0.0, until_s = 0.0;
  double noise_correlation = 0.0;  // ParallelFilter::neighbour_correlation() of its recording
};

// of a law: its columns among those of all
struct LawPlace {
  Effect const* effect = nullptr;
  std::optional<std::size_t> joint{};
  Eigen::Index first = 0, count = 0;
};

struct WholeArmRows {
  Eigen::MatrixXd model{}, laws{};  // n x R, n x L
  Eigen::VectorXd torque{};         // n
  std::vector<ArmRow> rows{};       // n
  std::vector<ArmStretch> stretches{};
  std::vector<LawPlace> places{};
};

inline constexpr Eigen::Index stretches_per_recording = 2 * n_folds;

// parameters: [R], at which laws are made; noise: [N]. Spreads laws over `threads`; same bits for any number
WholeArmRows whole_arm_rows(ArmModel const& model, Eigen::VectorXd const& parameters, Eigen::VectorXd const& noise,
                            std::span<RecordedArm const> recordings, ArmFilter const& filter,
                            std::span<Effect const* const> wanted, int threads = 1);

}  // namespace torquescope
