#include "engine/simulate/sticking_range.hpp"

#include <algorithm>

namespace torquescope {

StickingRange sticking_range(double encoder_step) {
  constexpr double least_creep = 1e-4, most_creep = 2e-2;             // rad/s or m/s
  constexpr double least_steps_per_s = 0.1, most_steps_per_s = 10.0;  // the same for a coarse encoder
  constexpr double most_steps = 3.0;                                  // of the encoder
  return {std::max(least_creep, least_steps_per_s * encoder_step),
          std::max(most_creep, most_steps_per_s * encoder_step), most_steps * encoder_step};
}

}  // namespace torquescope
