#pragma once
// A job turned into objects: what Experiment::load makes and the workflows use. Nothing here changes after load(), but
// that identify() lets go of the motion once it is written.

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/data/excitation.hpp"
#include "engine/data/motion.hpp"
#include "engine/data/recording.hpp"
#include "engine/data/recording_reader.hpp"
#include "engine/data/row_account.hpp"
#include "engine/diagnose/arms/arm_setup.hpp"
#include "engine/diagnose/arms/torque_delay.hpp"
#include "engine/effects/model_options.hpp"
#include "engine/effects/regressor.hpp"
#include "engine/experiment/estimator_plan.hpp"
#include "engine/experiment/experiment.hpp"
#include "engine/experiment/job/job.hpp"
#include "engine/experiment/job/job_options.hpp"
#include "engine/experiment/level_options.hpp"
#include "engine/experiment/rollout_parts.hpp"
#include "engine/fit/optim/objective.hpp"
#include "engine/fit/problem/arm_model.hpp"
#include "engine/fit/problem/filtered_grams.hpp"
#include "engine/fit/problem/fitness_choice.hpp"
#include "engine/fit/problem/recorded_arm.hpp"
#include "engine/fit/problem/regression_data.hpp"
#include "engine/fit/problem/regressor_health.hpp"
#include "engine/fit/problem/single_precision.hpp"
#include "engine/fit/problem/sufficient_statistics.hpp"
#include "engine/robot/robot_registry.hpp"

namespace torquescope {

// recordings of one purpose, as read and as the estimators see them
struct DataSet {
  std::vector<Recording> recordings;  // for a diagnosis whole, else without their channels: `regression` has taken them
  RegressionData regression;
  std::vector<Excitation> excitation;  // per recording
  bool simulated = false;
  std::vector<std::size_t> n_samples{};             // per recording, as read
  std::vector<std::vector<RowAccount>> accounts{};  // per recording: of its joint, or of each of an arm
  std::vector<std::vector<LoneRow>> lone{};         // likewise, one after the other: as the blocks of `regression`
  // of an arm: `recordings` has one entry a file, with what was found in any joint; `excitation` one a joint of each,
  // and `regression` the rows where a joint moves one way
  RegressionData other_rows{};
};

// what a job's arm is, beside its recordings
struct ArmParts {
  ArmModel model;
  std::string robot_file;                      // as the job names it
  std::string sha256;                          // of the chain that was read from it
  std::vector<FilteredGram> grams{};           // of the training rows
  NoiseLevels noise{};                         // of the joints
  std::optional<OtherConvention> otherwise{};  // of the robot file, for the same
  ArmSamples samples{};                        // of training recordings without a payload, for their set-up
  LaggedGrams lagged{};                        // of the training rows, for the time of the torques
  // of a diagnosis
  bool keeps_channels = false;
  std::vector<RecordedArm> train{}, validate{};
  std::vector<std::vector<Effect const*>> effects{};  // [N] it looks for
};

struct Experiment::Parts {
  Job job;
  ExperimentOptions experiment;
  OutputOptions output;
  FilterOptions filter;
  bool filter_is_chosen = false;           // the job has no [filter]
  double motion_hz = 0.0, noise_hz = 0.0;  // of the first recording (filter_suggestion.hpp); 0: not known
  std::optional<Regressor> regressor;      // of one joint; once loaded, either this
  std::optional<ArmParts> arm;             // or that is there
  DataSet train;
  std::optional<DataSet> validate;
  Reductions reductions;  // of the training rows, until the floor of their squared errors is known
  RegressorHealth health;
  Bounds box;
  bool box_is_default = false;                           // the job has no [model.bounds]: search_box.hpp
  Eigen::VectorXd truth;                                 // NaN where unknown
  std::vector<EstimatorPlan> estimators;                 // may be empty unless loaded for identify
  std::optional<SufficientStatistics> statistics;        // of the training rows, when an estimator would use them
  std::optional<SinglePrecisionCheck> single_precision;  // when an estimator wants float32
  DiagnoseOptions diagnose;
  LevelOptions levels;
  std::vector<Effect const*> effects;  // a diagnosis looks for
  // where an estimator simulates the recordings, or a replay does
  std::optional<RolloutParts> rollout{};

  std::size_t joints() const { return arm ? arm->model.joints() : 1; }
  std::vector<std::string> parameter_names() const { return rollout ? rollout->names : row_parameter_names(); }
  std::vector<std::string> parameter_units() const;
  std::size_t parameters() const { return rollout ? rollout->names.size() : row_parameters(); }
  // those that the rows of the fit are linear in; rollouts may have more: of effects and of the loop
  std::vector<std::string> row_parameter_names() const { return arm ? arm->model.names() : regressor->names(); }
  std::size_t row_parameters() const { return arm ? arm->model.size() : regressor->size(); }
  // an estimator searches by rollouts
  bool rolls_out() const;
  // of a row: "1" of an arm, whose rows are divided by the noise of their joint
  std::string torque_unit() const;
};

// at most, of all runs of a population method
std::int64_t evaluations_of(Experiment::Parts const& parts, EstimatorPlan const& plan);

// whether this population method looks at every sample or at the statistics, and why
FitnessChoice fitness_choice(Experiment::Parts const& parts, EstimatorPlan const& plan);

}  // namespace torquescope
