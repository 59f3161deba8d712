#pragma once
// What kind of thing an effect is: words that search, report and catalogue share (effects/README.md lists them all).

#include <string>

namespace torquescope {

// effects that imitate one another; when the member cannot be identified, the family is reported
enum class EffectFamily {
  baseline,         // part of the model one starts from
  reversal,         // shows where the joint turns round
  velocity_law,     // a curve of torque over velocity
  static_position,  // a curve of torque over position
  order_locked,     // waves per turn
  acceleration,     // acceleration, jerk, ringing
  time,             // changes while the recording runs
  load,             // follows the torque that is transmitted
  measurement,      // the channel, not the joint
  outside,          // torque from elsewhere
};

// axis of the mismatch map on which an effect stands out
enum class SignatureAxis {
  velocity,
  position,
  acceleration,
  load,
  since_velocity_reversal,
  since_torque_reversal,
  time,
  frequency,
  order
};

// columns under dq -> -dq, everything else equal and both directions alike
enum class Parity { odd, even, neither };

// what an effect adds to
enum class ActsOn {
  joint,              // torque the motor must give besides the baseline
  recorded_torque,    // torque that is written down but not there
  recorded_position,  // position that is read but not there
};

// of a search over a shape parameter; cubic: from a bound that is 0, where the effect is without it, by decades and yet
// down to it
enum class Spacing { linear, logarithmic, cubic };

std::string word(EffectFamily family);  // "velocity_law"
std::string word(SignatureAxis axis);   // "since_velocity_reversal"
std::string word(Parity parity);        // "odd"
std::string word(ActsOn place);         // "recorded_torque"

}  // namespace torquescope
