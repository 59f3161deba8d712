#pragma once
// Random numbers of a case, addressed by (suite seed, case, kind, purpose, attempt): the same bits on every machine.
//
// Source     Philox 4x32-10: Salmon, Moraes, Dror, Shaw 2011, doi:10.1145/2063384.2063405

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>

namespace sticking {

enum class Purpose : std::uint32_t {
  order,
  size,
  manner,
  rig,
  train_motion,
  other_motion,
  effect,
  train_noise,
  other_noise,
  pause
};

struct Address {
  std::uint64_t seed = 0;
  std::uint32_t number = 0;   // of the case
  std::uint32_t kind = 0;     // clean or single
  std::uint32_t attempt = 0;  // a draw that is no joint of the board is drawn anew
};

class Chance {
 public:
  Chance(Address const& at, Purpose purpose)
      : key_{static_cast<std::uint32_t>(at.seed), static_cast<std::uint32_t>(at.seed >> 32U)},
        counter_{0, at.number, at.kind << 16U | static_cast<std::uint32_t>(purpose), at.attempt} {}

  double uniform() {  // 0 <= x < 1
    std::uint64_t const high = word() >> 5U;
    std::uint64_t const low = word() >> 6U;
    return static_cast<double>(high << 26U | low) * 0x1.0p-53;
  }
  double between(double low, double high) { return low + (high - low) * uniform(); }
  double log_between(double low, double high) { return std::exp(between(std::log(low), std::log(high))); }
  bool happens(double share) { return uniform() < share; }
  double sign() { return happens(0.5) ? 1.0 : -1.0; }
  double angle() { return between(0.0, 2.0 * std::numbers::pi); }
  std::size_t index(std::size_t size) { return static_cast<std::size_t>(uniform() * static_cast<double>(size)); }
  double normal() {
    double const radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
    return radius * std::cos(angle());
  }

 private:
  std::uint32_t word() {
    if (used_ == block_.size()) next_block();
    return block_[used_++];
  }
  void next_block() {
    block_ = counter_;
    std::array<std::uint32_t, 2> key = key_;
    for (int round = 0; round < 10; ++round) {
      std::uint64_t const first = std::uint64_t{0xD2511F53} * block_[0];
      std::uint64_t const second = std::uint64_t{0xCD9E8D57} * block_[2];
      block_ = {static_cast<std::uint32_t>(second >> 32U) ^ block_[1] ^ key[0], static_cast<std::uint32_t>(second),
                static_cast<std::uint32_t>(first >> 32U) ^ block_[3] ^ key[1], static_cast<std::uint32_t>(first)};
      key[0] += 0x9E3779B9U;
      key[1] += 0xBB67AE85U;
    }
    ++counter_[0];
    used_ = 0;
  }

  std::array<std::uint32_t, 2> key_;
  std::array<std::uint32_t, 4> counter_;
  std::array<std::uint32_t, 4> block_{};
  std::size_t used_ = 4;
};

}  // namespace sticking
