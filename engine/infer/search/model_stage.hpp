#pragma once
// One model on one recording with its replicates: where a step of the search begins. Every accepted effect makes a new
// stage with new replicates, since a mismatch means nothing against replicates of another model.
//
// Threads    spreads replicates over `threads`; same bits for any number; a stage is a plain record
// Source     METHOD.md, Replicates

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "engine/infer/pipeline/reversal_rows.hpp"
#include "engine/infer/pipeline/trained_motion.hpp"
#include "engine/infer/replicates/ablation.hpp"
#include "engine/infer/replicates/baseline_twin.hpp"
#include "engine/infer/replicates/mismatch_energy.hpp"
#include "engine/infer/replicates/twin_exchange.hpp"
#include "engine/infer/search/candidate_columns.hpp"

namespace torquescope {

// what does not change from stage to stage
struct StageSetting {
  Recording const& recording;  // its time begins at 0
  Regressor const& regressor;
  FilterOptions const& filter;
  Section const& filter_section;
  std::size_t twins = 200;
  std::uint64_t seed = 0;
  int threads = 1;
  WanderReading wander = WanderReading::beside_motion;
  Ablation ablation{};
  std::shared_ptr<RecordedLoop const> loop{};     // as the first stage decided; none: decide
  std::shared_ptr<NoiseWeights const> weights{};  // the same
  std::optional<TwinLevels> levels{};             // of these terms; none: measure
  bool reads_colour = false;  // noise as the model leaves it, whatever the law says (torque_colour.hpp)
  ReversalRows reversals = ReversalRows::mask;
  double least_inertia_share = 0.0;                // of the model without effects (joint_fit.hpp); 0: as a rule
  std::shared_ptr<TrainedMotion const> trained{};  // rows of other recordings outside of it are left out; none: no row
  bool inertia_by_turns = false;             // a held inertia is one that a loop leads round the turns (joint_fit.hpp)
  std::optional<RecordedMotions> motions{};  // of the recording, as the first stage made them; none: make them
  TwinExchange* exchange = nullptr;          // processes that share the replicates; none by default

  TwinWorkers workers() const { return {threads, exchange}; }
};

// of a look at noise: two threads have something to do
inline constexpr std::size_t twins_per_round = 2 * twin_lanes;

// what all training recordings show of the motion
TrainedMotion trained_motion_of(StageSetting const& setting, std::span<Recording const> further);

// of a recording, with the setting's filter and rows
RecordPipeline pipeline_for(StageSetting const& setting, Recording const& recording, JointModel model);

// one fit to all training recordings, where there are several
struct PooledFit {
  Eigen::VectorXd parameters{};  // corrected for the bias of processing
  Eigen::MatrixXd deviations{};  // of every replicate's fit from their mean: columns of the model, one per tangent; x M
  Eigen::VectorXd jackknife{};   // deviations by leaving out blocks of the rows
};

struct ModelStage {
  std::unique_ptr<RecordPipeline> pipeline{};  // restricted to the common rows
  std::optional<BaselineTwin> twin{};          // always there in a stage that make_stage() returned
  TwinComparison comparison{};
  MismatchEnergy energy{};
  std::optional<PooledFit> pooled{};  // as the search fills it in (moving_rows/pooled_fit.hpp)

  JointModel const& model() const { return pipeline->model(); }
  // that replicates are simulated with: of this recording, corrected for the bias of processing
  Eigen::VectorXd const& parameters() const { return twin->baseline.parameters; }
  // of all training recordings: what is reported, and predicts others
  Eigen::VectorXd const& estimate() const { return pooled ? pooled->parameters : parameters(); }
  Eigen::VectorXd mismatch() const { return comparison.rows.residual - comparison.rows.twin_mean; }
  // what candidates need to know of the baseline: this stage's own parameters
  BaselineReference reference() const;
};

// the same for the stage's model, and its fits bounded as the stage's are
RecordPipeline pipeline_for(StageSetting const& setting, Recording const& recording, ModelStage const& stage);
// model: the stage's, with events at other instants
RecordPipeline pipeline_for(StageSetting const& setting, Recording const& recording, ModelStage const& stage,
                            JointModel model);

// of a recording that is predicted: that move one way within the motion of training
Eigen::Index judged_rows(StageSetting const& setting, Recording const& recording);

// nothing when the twins run away: such a model is none of this joint
// Errors     Error 65 as the pipeline and the twins, for a model without effects only
std::optional<ModelStage> make_stage(StageSetting const& setting, JointModel model);

// The same model with all its twins, its levels known and rows weighed by the noise that its own twins have. What is
// missing at first passes for noise in part, so that the weights of one stage are too coarse for the next
std::optional<ModelStage> reweighed_stage(StageSetting const& setting, ModelStage const& stage);

// Whether the last effect of the stage, as corrected by its own twins, is more than twice as large as it can be: a
// bound on a linear parameter is given in sizes of the joint, by this stage or by the one before, whichever says more.
// Least squares on two columns that are nearly the same finds such pairs, and no joint has them
bool is_far_too_large(ModelStage const& stage, JointScales const& before);

// energy of a stage's mismatch under another one's weights, over that under its own: what a unit of energy has become
double energy_unit_under(ModelStage const& stage, RecordPipeline const& other);

}  // namespace torquescope
