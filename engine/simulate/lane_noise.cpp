#include "engine/simulate/lane_noise.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/base/portable_math.hpp"
#include "engine/base/random_stream.hpp"
#include "kernels/normal_quantiles.hpp"

namespace torquescope {

std::uint32_t stream_number(ReplicateAddress const& address, ReplicateStream stream) {
  constexpr std::uint32_t most_streams = 8;
  static_assert(static_cast<std::uint32_t>(ReplicateStream::wander_level) < most_streams, "would be another set's");
  return address.set * most_streams + static_cast<std::uint32_t>(stream);
}

namespace {

// streams of all lanes of a group
kernels::PhiloxStreams lane_streams(ReplicateAddress const& address, ReplicateStream stream, std::uint32_t group) {
  RandomKey const key{address.seed, address.recording, RandomDomain::replicate};
  auto const philox_key = RandomStream::philox_key(key);
  auto const counter = RandomStream::first_counter(key, stream_number(address, stream),
                                                   group * static_cast<std::uint32_t>(replicate_lanes));
  return {{philox_key[0], philox_key[1]}, counter[1], counter[2], counter[3]};
}

}  // namespace

LaneNoise::LaneNoise(ReplicateAddress const& address, ReplicateStream stream, std::uint32_t group, Autoregression model)
    : model_(std::move(model)),
      streams_(lane_streams(address, stream, group)),
      history_(model_.past.size() * replicate_lanes, 0.0) {
  // from nothing to stationary
  constexpr std::size_t settling = 20;
  alignas(64) double dropped[replicate_lanes];
  for (std::size_t k = 0; k < settling * model_.past.size(); ++k) next(dropped);
}

void LaneNoise::draw() {
  constexpr std::size_t n_blocks = ticks_together / 2, words = 4;  // a block of four words is two draws
  std::array<std::uint32_t, replicate_lanes * n_blocks * words> drawn;
  kernels::philox_blocks(streams_, replicate_lanes, next_block_, n_blocks, drawn.data());
  next_block_ += n_blocks;
  for (std::size_t lane = 0; lane < replicate_lanes; ++lane)
    for (std::size_t tick = 0; tick < ticks_together; ++tick) {
      std::uint32_t const* const two = drawn.data() + (lane * ticks_together + tick) * 2;
      normals_[tick * replicate_lanes + lane] = RandomStream::probability(std::uint64_t{two[1]} << 32 | two[0]);
    }
  kernels::normal_quantiles(normals_.data(), normals_.size(), normals_.data());
  tick_ = 0;
}

void LaneNoise::next(double* out) {
  if (model_.innovation == 0.0) {
    std::fill_n(out, replicate_lanes, 0.0);
    return;
  }
  if (tick_ == ticks_together) draw();
  double const* const fresh = normals_.data() + tick_++ * replicate_lanes;
  for (std::size_t lane = 0; lane < replicate_lanes; ++lane) out[lane] = model_.innovation * fresh[lane];
  std::size_t const order = model_.past.size();
  if (order == 0) return;
  std::size_t place = newest_;
  for (double const weight : model_.past) {
    double const* const before = history_.data() + place * replicate_lanes;
    for (std::size_t lane = 0; lane < replicate_lanes; ++lane) out[lane] += weight * before[lane];
    if (++place == order) place = 0;
  }
  newest_ = (newest_ == 0 ? order : newest_) - 1;
  std::copy_n(out, replicate_lanes, history_.data() + newest_ * replicate_lanes);
}

LaneLevels::LaneLevels(ReplicateAddress const& address, ReplicateStream stream, std::uint32_t group, double std,
                       double variance_error) {
  LaneNoise error(address, stream, group, white(variance_error));
  error.next(std_);
  for (double& one : std_) {
    one = std::sqrt(std::max(0.0, std * std + one));
    is_any_ = is_any_ || one > 0.0;
  }
}

LaneFriction::LaneFriction(ReplicateAddress const& address, std::uint32_t group, ReplicateLoop const& loop,
                           double tick_s)
    : std_(address, ReplicateStream::wander_level, group, loop.friction_wander * std::sqrt(tick_s),
           loop.friction_wander_variance_error * tick_s),
      change_(address, ReplicateStream::wander, group, white(1.0)) {
  std::fill_n(level_, replicate_lanes, 1.0);
}

void LaneFriction::next() {
  if (!std_.is_any()) return;
  double change[replicate_lanes];
  change_.next(change);
  for (std::size_t lane = 0; lane < replicate_lanes; ++lane)
    level_[lane] = std::max(0.0, level_[lane] + std_[lane] * change[lane]);
}

void draw_sticking(ReplicateAddress const& address, std::uint32_t group, StickingRange const& range,
                   double start_velocity, LaneSticking& sticking) {
  double const sizes = range.most_creep > 0.0 ? portable_log(range.most_creep / range.least_creep) : 0.0;
  for (std::uint32_t lane = 0; lane < replicate_lanes; ++lane) {
    RandomStream random({address.seed, address.recording, RandomDomain::replicate},
                        stream_number(address, ReplicateStream::start),
                        (second_half + group) * static_cast<std::uint32_t>(replicate_lanes) + lane);
    sticking.creep[lane] = range.least_creep * portable_exp(random.uniform() * sizes);
    // what bristles give back goes with the square root of their length; every second joint has none
    double const kick = std::max(0.0, random.uniform(-1.0, 1.0));
    sticking.length[lane] = range.most_length * kick * kick;
    sticking.bend[lane] = start_velocity > 0.0 ? 1.0 : start_velocity < 0.0 ? -1.0 : 0.0;
  }
}

}  // namespace torquescope
