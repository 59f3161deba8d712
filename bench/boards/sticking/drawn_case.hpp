#pragma once
// A whole case of the board, drawn from (suite seed, case number, kind) alone.

#include <cstdint>
#include <optional>
#include <string>

#include "sticking/hidden_effect.hpp"
#include "sticking/recording.hpp"
#include "sticking/rig.hpp"

namespace sticking {

constexpr double smallest_size = 0.003, largest_size = 0.05;  // of a hidden effect, share of the torque's rms

struct Case {
  Address at;
  Rig rig;
  std::optional<HiddenEffect> effect;
  Recording train, other;
  double torque_rms = 0.0;     // of the training recording
  double effect_size = 0.0;    // relative sizes: relative_size()
  double lag_size = 0.0;       // of the drive's lag, where the command is recorded
  double sticking_size = 0.0;  // of what the sticking law does that sign(v) does not
};

// kind: "clean" or "single"; std::invalid_argument for another
Case draw_case(std::uint64_t seed, std::uint32_t number, std::string const& kind);

}  // namespace sticking
