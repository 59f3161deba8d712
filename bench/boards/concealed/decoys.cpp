#include "concealed/decoys.hpp"

#include <stdexcept>

#include "concealed/closed_loop.hpp"
#include "concealed/instruments/faults.hpp"

namespace concealed {

std::vector<std::string> const& decoys() {
  static std::vector<std::string> const kinds = {"encoder", "stamps", "late", "filter", "hold"};
  return kinds;
}

std::vector<std::string> const& wrong_regimes() {
  static std::vector<std::string> const kinds = {"noise", "gains", "encoder"};
  return kinds;
}

std::vector<std::string> const& measurement_names() {
  static std::vector<std::string> const names = {"actuator_lag", "clipping", "delay", "encoder_eccentricity",
                                                 "sensor_drift"};
  return names;
}

void put_decoy(Rig& rig, std::string const& kind, Random& random) {
  if (kind == "encoder") {
    // either coarse and honest about it, or with last digits that say nothing
    if (random.uniform() < 0.5) {
      rig.encoder_bits = 13;
    } else {
      rig.noisy_bits = 2;
    }
  } else if (kind == "stamps") {
    rig.nominal_stamps = true;
    rig.noise.clock_jitter = random.between(0.02, 0.1);
  } else if (kind == "late") {
    rig.instruments.push_back(late_torque((1 + static_cast<double>(random.index(6))) * tick_s, tick_s));
  } else if (kind == "filter") {
    rig.instruments.push_back(filtered_torque(random.between(30.0, 120.0), tick_s));
  } else if (kind == "hold") {
    rig.instruments.push_back(held_torque(2 + static_cast<int>(random.index(7))));
  } else {
    throw std::invalid_argument("no decoy named " + kind);
  }
}

void put_wrong_regime(Rig& rig, std::string const& kind, Random& random) {
  if (kind == "noise") {
    NoiseLevel twice = noise_named("workshop");
    twice.name = "loud";
    for (double* level : {&twice.white, &twice.coloured, &twice.disturbance, &twice.friction_wander}) *level *= 2.0;
    rig.noise = twice;
  } else if (kind == "gains") {
    rig.controller.bandwidth_hz *= random.uniform() < 0.5 ? 0.9 : 1.1;
  } else if (kind == "encoder") {
    rig.joint.travel_per_turn *= random.between(0.6, 1.0);
    rig.noisy_bits = 1;
  } else {
    throw std::invalid_argument("no regime named " + kind);
  }
}

}  // namespace concealed
