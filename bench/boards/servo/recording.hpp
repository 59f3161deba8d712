#pragma once
// A recording: the servo follows the goals of a motion, and its encoder is read at each sample.
//
// Order      at one time the sample's goal comes first, then its reading, then the tick of the drive that uses both
// Start      at rest under the first goal, which has been held for long
// Units      rad, s

#include <vector>

#include "servo/motion.hpp"
#include "servo/servo_numbers.hpp"

namespace servo {

struct Recording {
  std::vector<double> read;      // q_rad, as the encoder has it
  std::vector<double> position;  // what it was
};

Recording record(ServoNumbers const& servo, Setting const& setting, std::vector<Sample> const& samples);

}  // namespace servo
