#pragma once
// The simulated copy of a recording from which replicates are drawn: loop found, baseline corrected, noise levelled.
//
// Steps      least squares on the rows; loop (recorded_loop.hpp); parameters by indirect inference; levels of
//            disturbance and of the friction random walk, then the parameters again. A loop that diverges becomes a
//            tracking loop
// Loop       decided once per recording. Effects of the torque channel ask for it again: no controller saw them
// Colour     torque noise of a tracking loop is read by torque_colour.hpp, anew with every model
// Sets       sets 0 to 2 of (seed, recording) are used here; a null distribution takes another set
// Errors     Error 65 as the parts; also when replicates diverge in the tracking loop too
// Threads    spreads replicates over the threads and processes of `workers`; same bits for any number
// Source     METHOD.md, Replicates

#include <cstdint>
#include <memory>
#include <optional>

#include "engine/infer/pipeline/record_pipeline.hpp"
#include "engine/infer/pipeline/recorded_loop.hpp"
#include "engine/infer/replicates/baseline_correction.hpp"
#include "engine/infer/replicates/disturbance_level.hpp"
#include "engine/infer/replicates/friction_wander.hpp"
#include "engine/infer/replicates/torque_colour.hpp"
#include "engine/infer/replicates/twin_exchange.hpp"

namespace torquescope {

// what was measured on the same recording before, with the same terms; their shapes may be others
struct TwinLevels {
  Eigen::VectorXd correction;  // of the least squares fit: where the correction of another one begins
  NoiseLevel disturbance;
  NoiseLevel friction_wander;
  std::optional<TorqueColour> colour{};  // where no controller separates it
};

struct TwinOptions {
  double step_s = 1e-4;    // of the integrator, second order
  std::size_t twins = 16;  // per round of the correction and of the level
  std::uint64_t seed = 0;
  std::uint32_t recording = 0;
  WanderReading wander = WanderReading::beside_motion;
  std::shared_ptr<RecordedLoop const> loop{};  // as decided before; none: decide
  bool reads_colour = false;                   // of the torque noise, from what the model leaves, whatever the law says
  bool draws_sticking = false;                 // every replicate its own law of it (sticking_range.hpp)
  std::optional<TwinLevels> levels{};          // known: only the parameters are corrected; none: measure
  std::optional<RecordedMotions> motions{};    // of the recording, where somebody has them
};

struct BaselineTwin {
  ProcessedRecord record;  // of the recording itself
  RecordedLoop loop;       // its `loop` includes the disturbance found
  BaselineCorrection baseline;
  NoiseLevel disturbance;
  NoiseLevel friction_wander;
  std::optional<TorqueColour> colour;  // spectrum of the torque noise, where no controller separates it
  CleanTwin twin;
};

inline constexpr std::uint32_t first_free_twin_set = 3;

TwinLevels levels_of(BaselineTwin const& made);

// the friction random walk once more, under the weights that the pipeline has now
NoiseLevel measured_wander(Recording const& recording, BaselineTwin const& made, RecordPipeline const& pipeline,
                           TwinOptions const& options, TwinWorkers const& workers);

BaselineTwin make_baseline_twin(Recording const& recording, RecordPipeline const& pipeline, FilterOptions const& filter,
                                TwinOptions const& options, TwinWorkers const& workers);

}  // namespace torquescope
