#include "engine/effects/effect_traits.hpp"

namespace torquescope {

std::string word(EffectFamily family) {
  switch (family) {
    case EffectFamily::baseline:
      return "baseline";
    case EffectFamily::reversal:
      return "reversal";
    case EffectFamily::velocity_law:
      return "velocity_law";
    case EffectFamily::static_position:
      return "static_position";
    case EffectFamily::order_locked:
      return "order_locked";
    case EffectFamily::acceleration:
      return "acceleration";
    case EffectFamily::time:
      return "time";
    case EffectFamily::load:
      return "load";
    case EffectFamily::measurement:
      return "measurement";
    case EffectFamily::outside:
      return "outside";
  }
  return {};
}

std::string word(SignatureAxis axis) {
  switch (axis) {
    case SignatureAxis::velocity:
      return "velocity";
    case SignatureAxis::position:
      return "position";
    case SignatureAxis::acceleration:
      return "acceleration";
    case SignatureAxis::load:
      return "load";
    case SignatureAxis::since_velocity_reversal:
      return "since_velocity_reversal";
    case SignatureAxis::since_torque_reversal:
      return "since_torque_reversal";
    case SignatureAxis::time:
      return "time";
    case SignatureAxis::frequency:
      return "frequency";
    case SignatureAxis::order:
      return "order";
  }
  return {};
}

std::string word(Parity parity) {
  switch (parity) {
    case Parity::odd:
      return "odd";
    case Parity::even:
      return "even";
    case Parity::neither:
      return "neither";
  }
  return {};
}

std::string word(ActsOn place) {
  switch (place) {
    case ActsOn::joint:
      return "joint";
    case ActsOn::recorded_torque:
      return "recorded_torque";
    case ActsOn::recorded_position:
      return "recorded_position";
  }
  return {};
}

}  // namespace torquescope
