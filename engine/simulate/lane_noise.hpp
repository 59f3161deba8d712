#pragma once
// What is random in a group of replicates, lane by lane: noises, their levels, the friction random walk, sticking.
//
// Random     addressed by (seed, recording, set, stream, replicate, draw): one lane's numbers do not depend on its
//            neighbours
// Shapes     every array: replicate_lanes
// Threads    an object belongs to one group on one thread

#include <array>
#include <cstdint>
#include <vector>

#include "engine/base/random_stream.hpp"
#include "engine/simulate/replicate_simulator.hpp"
#include "engine/simulate/sticking_lanes.hpp"
#include "kernels/philox.hpp"

namespace torquescope {

// numbers are part of the address: never renumber
enum class ReplicateStream : std::uint32_t {
  torque = 0,
  disturbance = 1,
  position = 2,
  level = 3,
  start = 4,
  phase = 5,
  wander = 6,
  wander_level = 7
};

std::uint32_t stream_number(ReplicateAddress const& address, ReplicateStream stream);

// streams have a second half, for what goes beside the first: no batch has so many groups
inline constexpr std::uint32_t second_half = std::uint32_t{1} << 24;

// one noise of one group: an autoregression per lane
class LaneNoise {
 public:
  LaneNoise(ReplicateAddress const& address, ReplicateStream stream, std::uint32_t group, Autoregression model);
  // the next sample of every lane
  void next(double* out);

 private:
  static constexpr std::size_t ticks_together = 16;  // many normals cost a third of as many alone

  void draw();

  Autoregression model_;
  kernels::PhiloxStreams streams_;                                  // neighbours, one per lane
  std::size_t next_block_ = 0;                                      // of every stream
  std::array<double, ticks_together * replicate_lanes> normals_{};  // of the present ticks, tick by tick
  std::size_t tick_ = ticks_together;                               // of these, the next one to give
  std::vector<double> history_;                                     // [order][lanes], a ring
  std::size_t newest_ = 0;
};

// The standard deviation of a noise in every lane, drawn about the one that was found with the error of its square: the
// null knows what is not known. Where none was found there may still be one.
class LaneLevels {
 public:
  LaneLevels(ReplicateAddress const& address, ReplicateStream stream, std::uint32_t group, double std,
             double variance_error);
  bool is_any() const { return is_any_; }
  double operator[](std::size_t lane) const { return std_[lane]; }

 private:
  double std_[replicate_lanes];
  bool is_any_ = false;  // asked for at every tick
};

// the level of dry friction, 1 at the start: a random walk that does not go below 0
class LaneFriction {
 public:
  LaneFriction(ReplicateAddress const& address, std::uint32_t group, ReplicateLoop const& loop, double tick_s);
  double const* level() const { return level_; }
  void next();

 private:
  LaneLevels std_;  // of one tick's change
  LaneNoise change_;
  double level_[replicate_lanes];
};

// the sticking of every lane, one draw of the creep and one of the length; bent as of a joint that moves at
// start_velocity
void draw_sticking(ReplicateAddress const& address, std::uint32_t group, StickingRange const& range,
                   double start_velocity, LaneSticking& sticking);

}  // namespace torquescope
