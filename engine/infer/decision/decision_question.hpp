#pragma once
// What a decision about one joint is made of: recordings, model, effects to ask for, numbers.
//
// Threads    plain record; looks into recordings, regressor and filter, which outlive it

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "engine/data/motion.hpp"
#include "engine/data/recording.hpp"
#include "engine/effects/regressor.hpp"
#include "engine/infer/decision/decision_numbers.hpp"

namespace torquescope {

struct DecisionQuestion {
  std::span<Recording const> training, validation;  // of one joint; their time from 0
  Regressor const& regressor;
  FilterOptions const& filter;
  Section const& filter_section;
  std::vector<Effect const*> effects{};
  std::size_t most_effects = 5;
  bool weighs_rows = true;  // by what replicates leave there (row_weights.hpp); else all alike
  DecisionNumbers numbers{};
  std::uint64_t seed = 0;
  int threads = 1;
  std::function<void(char const* stage, std::size_t done, std::size_t total)> progress{};
};

}  // namespace torquescope
