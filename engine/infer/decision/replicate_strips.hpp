#pragma once
// Replicates of the recordings of one joint by one model: simulated, every one with its own sticking of friction and
// its own place of the encoder's steps.
//
// Drive      the recorded torque, led slowly to the measured motion (recorded_loop.hpp); where the joint runs away, a
//            loop that follows the motion closely; where it runs away in that as well, the measured motion itself with
//            the model's torque
// Given      torque of given columns (masses of an arm) is that of the measured motion in every replicate: the joint
//            moves without it, and its gear carries it
// Noise      none in the loop: the caller adds it to the rows (row_noise.hpp)
// Rows       those of the recording
// Random     addressed by (seed, recording, step of the search, replicate)
// Threads    spreads groups of replicates over `threads`; same bits for any number
// Source     parametric bootstrap: Davison, Hinkley 1997, doi:10.1017/CBO9780511802843

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/infer/decision/treatment_choice.hpp"
#include "engine/infer/pipeline/recorded_loop.hpp"

namespace torquescope {

enum class ReplicateSource { recorded_torque, tracking_loop, measured_motion };

struct ReplicateSetting {
  std::span<Recording const> recordings;
  FilterOptions const& filter;
  StickingBounds sticking{};  // what is drawn
  std::uint64_t seed = 0;
  std::uint32_t step = 0;  // of the search
  int threads = 1;
};

// of one recording
class ReplicateMaker {
 public:
  // recording, strips and model outlive it
  ReplicateMaker(ReplicateSetting const& setting, std::size_t recording, ModelOnStrips const& on,
                 ChosenTreatment const& chosen);

  ReplicateSource source() const { return source_; }
  RecordedLoop const& loop() const { return loop_; }
  // replicates [first, first + count); first a multiple of replicate_lanes
  std::vector<Strip> strips(std::size_t first, std::size_t count) const;

 private:
  std::vector<Strip> simulated(std::size_t first, std::size_t count) const;
  Strip on_measured_motion(std::size_t replicate) const;

  ReplicateSetting setting_;
  Recording const* recording_;
  Eigen::VectorXd given_{};  // torque of given terms of the model, at the full rate; none
  Strip const* strip_;
  ModelOnStrips const* on_;
  std::size_t place_;
  ChosenTreatment const* chosen_;
  ReplicateSource source_ = ReplicateSource::measured_motion;
  RecordedLoop loop_{};
  std::optional<ReplicateSimulator> replicate_{};
};

}  // namespace torquescope
