#pragma once
// The clean twin of a recording, ready to be multiplied: loop found, baseline corrected, noise and disturbance
// levelled.
//
// Steps      least squares on the recording's rows; loop (recorded_loop.hpp); parameters by indirect inference; level
//            of the disturbance and of what dry friction wanders, and when there is one of them the parameters again
//            under it. A loop that runs away is replaced by the tracking loop
// Loop       decided once: later models of the same recording are told the first one's, or unlike twins would be
//            compared. Effects of the torque channel ask for another look at it: a controller never saw what they add
// Colour     of the torque noise: an identified loop has it from its own remainder; in a tracking loop
//            torque_colour.hpp reads it from what the model leaves, anew with every model, where there is no reference
//            or twins would be louder than the recording
// Sets       twin sets 0 to 2 of (seed, recording) are used up here; a null distribution takes another set
// Errors     Error 65 as the parts; also when twins run away in the tracking loop too
// Units      SI
// Threads    spreads twins over the threads and processes of `workers`; same bits for any number; result is a plain
//            record
// Source     LESSONS items 1 to 8 of our own prototype

#include <cstdint>
#include <memory>
#include <optional>

#include "engine/pipeline/record_pipeline.hpp"
#include "engine/pipeline/recorded_loop.hpp"
#include "engine/twin/baseline_correction.hpp"
#include "engine/twin/disturbance_level.hpp"
#include "engine/twin/friction_wander.hpp"
#include "engine/twin/torque_colour.hpp"
#include "engine/twin/twin_exchange.hpp"

namespace torquescope {

// what was measured on the same recording and model before
struct TwinLevels {
  Eigen::VectorXd parameters;  // to begin the correction with
  NoiseLevel disturbance;
  NoiseLevel friction_wander;
  std::optional<TorqueColour> colour{};  // where no controller tells it
};

struct TwinOptions {
  double step_s = 1e-4;    // of the integrator, second order
  std::size_t twins = 16;  // per round of the correction and of the level
  std::uint64_t seed = 0;
  std::uint32_t recording = 0;
  WanderReading wander = WanderReading::beside_motion;
  std::shared_ptr<RecordedLoop const> loop{};  // as decided before; none: decide
  bool reads_colour = false;                   // of the torque noise, from what the model leaves, whatever the law says
  std::optional<TwinLevels> levels{};          // known: only the parameters are corrected; none: measure
};

struct BaselineTwin {
  ProcessedRecord record;  // of the recording itself
  RecordedLoop loop;       // its `loop` includes the disturbance found
  BaselineCorrection baseline;
  NoiseLevel disturbance;
  NoiseLevel friction_wander;
  std::optional<TorqueColour> colour;  // of the torque noise, where no controller tells it
  CleanTwin twin;
};

inline constexpr std::uint32_t first_free_twin_set = 3;

TwinLevels levels_of(BaselineTwin const& made);

// the wander of dry friction once more, under the weights that the pipeline has now
NoiseLevel measured_wander(Recording const& recording, BaselineTwin const& made, RecordPipeline const& pipeline,
                           TwinOptions const& options, TwinWorkers const& workers);

BaselineTwin make_baseline_twin(Recording const& recording, RecordPipeline const& pipeline, FilterOptions const& filter,
                                TwinOptions const& options, TwinWorkers const& workers);

}  // namespace torquescope
