#pragma once
// The loop of loop_numbers.hpp round the joint of replicate_lanes.hpp, for sixteen trials side by side: tick by tick,
// in vector registers.
//
// At a tick  the loop reads the position, answers, and its torque is held until the next tick; every hold_ticks-th tick
//            of a slower controller answers
// Shapes     rows of a chunk: [ticks][replicate_lanes]
// Accuracy   as replicate_lanes.hpp; the sine of the weight is carried on from tick to tick by its series of fifth
//            order and made anew with every chunk: a turn d a tick leaves d^6 / 720 of the weight
// Bits       of a lane: the same on every instruction set, whatever stands in the other lanes
// Threads    any number, each with its own states; does not allocate

#include <cstddef>

#include "engine/simulate/lane_step.hpp"
#include "engine/simulate/replicate_lanes.hpp"
#include "engine/simulate/rollout/gear_friction.hpp"
#include "engine/simulate/rollout/loop_numbers.hpp"

namespace torquescope {

inline constexpr std::size_t most_delay_ticks = 256;
inline constexpr std::size_t chunk_ticks = 256;
inline constexpr std::size_t most_speed_samples = 16;

// numbers of every lane, for one tick of tick_s
struct LaneLoops {
  using Lanes = double[replicate_lanes];
  alignas(64) Lanes kp{}, kd{}, ki{}, ki_speed{}, feed_speed{}, feed_acceleration{}, added_gain{};
  alignas(64) Lanes least{}, most{}, speed_share{}, back_emf{}, goal_step{}, goal_change{};
  alignas(64) Lanes late_share{}, lag_end{}, lag_mean{}, log_share{};
  alignas(64) Lanes motor_gain{}, dead_band{}, punch{};
  alignas(64) Lanes encoder_step{}, encoder_phase{};  // that the loop and the record read by; 0: exactly
  std::size_t late_ticks[replicate_lanes] = {};
  double tick_s = 0.0;
  std::size_t hold_ticks = 1;
  bool has_profile = false, has_feed = false, has_integral = false, has_delay = false, has_lag = false;
  bool has_least_drive = false, has_encoder = false;

  std::size_t speed_samples = 1;  // that the difference of what it reads spans; 0: it sees the joint's own speed
  double period_s = 0.0, per_period = 0.0, per_span = 0.0;  // between two answers; over so many samples

  LaneLoops(double tick_s, std::size_t hold_ticks, std::size_t speed_samples = 1);
  void set(std::size_t lane, LoopNumbers const& numbers);
  void set_encoder(std::size_t lane, double step, double phase);
};

// where the loop stands between its answers, the same for all lanes
struct LoopClock {
  std::size_t tick = 0, until_answer = 0, place = 0;  // place: of the next read in its ring
  bool answers() const { return until_answer == 0; }
  void advance(LaneLoops const& loops) {
    if (answers()) {
      until_answer = loops.hold_ticks;
      place = place + 1 < loops.speed_samples ? place + 1 : 0;
    }
    --until_answer;
    ++tick;
  }
};

// what the loop remembers
struct LaneLoopState {
  using Lanes = double[replicate_lanes];
  alignas(64) Lanes goal{}, goal_speed{}, goal_before{}, goal_step_before{}, speed{}, integral{};
  alignas(64) Lanes command{}, lagged{}, logged{};
  LoopClock clock{};
  alignas(64) double reads[most_speed_samples][replicate_lanes] = {};   // a ring, by answer
  alignas(64) double commands[most_delay_ticks][replicate_lanes] = {};  // a ring, by tick

  // at a first tick that follows rest or an even motion: position, velocity, goal and the command that was held before;
  // the integral takes up what the other parts leave of it. NaN: the command is what the loop answers at rest
  void start(LaneLoops const& loops, LaneState const& joint, double const* goal, double torque);
};

// of one chunk; each may be none: zeros, no added command, a drive that is on
struct TickInputs {
  double const* goal = nullptr;               // [ticks][lanes], delayed; or [ticks] where all lanes see the same
  std::size_t goal_stride = replicate_lanes;  // 1 of the latter
  double const* added = nullptr;              // [ticks]
  double const* outside = nullptr;            // [ticks], torque on the joint from outside
  double const* enabled = nullptr;            // [ticks], 1 or 0
};

// [ticks][lanes], at the ticks: positions and speeds as they are, the torque as it is logged
struct TickOutputs {
  double* position = nullptr;
  double* velocity = nullptr;
  double* torque = nullptr;
};

// gear_friction.hpp, one a lane
struct LaneGears {
  using Lanes = double[replicate_lanes];
  alignas(64) Lanes load{}, load_square{}, stribeck{}, load_stribeck{}, per_speed{}, motor_share{};
  alignas(64) Lanes angle_cos{}, angle_sin{};
  bool any = false, turns = false;

  void set(std::size_t lane, GearFriction const& gear);
};

struct RolledJoints {
  LaneJoints joints{};
  LaneDryFriction dry{};
  LaneGears gears{};
  alignas(64) double offset[replicate_lanes] = {};

  bool needs_angle() const { return joints.has_weight || gears.turns; }
};

// what the gears add to dry friction at this tick: motor, weight: torques on the joint; sine, cosine: of its angle;
// [lanes]
void gear_friction(LaneGears const& gears, double const* motor, double const* weight, double const* speed,
                   double const* sine, double const* cosine, double* friction);

// `ticks` <= chunk_ticks ticks of `steps` steps each, of a joint without effects
void roll_ticks(RolledJoints const& rolled, LaneLoops const& loops, TickInputs const& inputs, std::size_t ticks,
                std::size_t steps, LaneState& joint, LaneLoopState& loop, TickOutputs const& outputs);

// the loop's half of one tick: read -> held, what the motor gives until the next, and logged, the command as it is
// logged. read: the positions that the encoder shows; speed: of the joint; row: of the inputs
void answer_tick(LaneLoops const& loops, TickInputs const& inputs, std::size_t row, double const* read,
                 double const* speed, LaneLoopState& loop, double* held, double* logged);
// the same from a command on, where another controller gave it
void pass_on_tick(LaneLoops const& loops, TickInputs const& inputs, std::size_t row, double const* command,
                  LaneLoopState& loop, double* held, double* logged);

}  // namespace torquescope
