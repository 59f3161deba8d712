// Twelve recordings with nothing missing: every rig twice, all loops, noises and formats.
#include "stranger/cases.hpp"

namespace stranger {
namespace {

Case clean(std::string name, std::string rig, std::string train, std::string validation, double train_s,
           double validation_s) {
  Case c = usual(std::move(name), "clean", std::move(rig));
  c.train_motion = std::move(train), c.validation_motion = std::move(validation);
  c.train_s = train_s, c.validation_s = validation_s;
  return c;
}

}  // namespace

std::vector<Case> clean_cases() {
  std::vector<Case> cases;
  cases.push_back(clean("clean_belt_trapezoids", "belt", "trapezoids", "mixed", 30, 20));
  {
    Case c = clean("clean_belt_counts", "belt", "pick_place", "irregular", 40, 25);
    c.loop = {"pd", 2000, 5, 0.7, 100, 0.9};
    c.instruments.log_hz = 500, c.instruments.mean_torque = true;
    c.instruments.position = PositionWord::counts, c.instruments.torque = TorqueWord::amperes;
    cases.push_back(c);
  }
  {
    Case c = clean("clean_pan_degrees", "pan", "multisine", "trapezoids", 30, 20);
    c.instruments.position = PositionWord::degrees, c.instruments.white = 0.02;
    cases.push_back(c);
  }
  {
    Case c = clean("clean_pan_epoch", "pan", "irregular", "multisine", 25, 20);
    c.loop = {"cascade", 8000, 5, 0.9, 150, 0};
    c.instruments.log_hz = 2000, c.instruments.time = TimeWord::epoch, c.instruments.coloured = 0.02;
    c.instruments.counts_per_unit = encoder_bits(18);
    cases.push_back(c);
  }
  {
    Case c = clean("clean_arm_mixed", "arm", "mixed", "irregular", 40, 25);
    c.instruments.white = 0.012, c.instruments.coloured = 0.008;
    cases.push_back(c);
  }
  {
    Case c = clean("clean_arm_no_reference", "arm", "pick_place", "trapezoids", 30, 20);
    c.loop = {"pid", 8000, 4, 0.8, 120, 0.6};
    c.instruments.log_hz = 4000, c.instruments.reference = false;
    cases.push_back(c);
  }
  {
    Case c = clean("clean_gear_creep", "gear", "creep", "trapezoids", 50, 30);
    c.instruments.position = PositionWord::degrees, c.instruments.torque = TorqueWord::amperes;
    cases.push_back(c);
  }
  {
    Case c = clean("clean_gear_tacho", "gear", "chirp", "pick_place", 60, 30);
    c.loop = {"pd", 2000, 3, 0.8, 60, 0.5};
    c.instruments.log_hz = 250, c.instruments.velocity = true, c.instruments.coloured = 0.015;
    cases.push_back(c);
  }
  {
    Case c = clean("clean_direct_chirp", "direct", "chirp", "irregular", 20, 15);
    c.loop = {"cascade", 8000, 8, 0.8, 200, 0};
    c.instruments.log_hz = 4000;
    cases.push_back(c);
  }
  {
    Case c = clean("clean_direct_micro", "direct", "micro", "mixed", 30, 20);
    c.instruments.white = 0.015, c.instruments.coloured = 0.01, c.instruments.coloured_hz = 2;
    cases.push_back(c);
  }
  {
    Case c = clean("clean_servo_permille", "servo", "multisine", "pick_place", 45, 30);
    c.instruments.position = PositionWord::counts, c.instruments.torque = TorqueWord::permille;
    c.instruments.time = TimeWord::none;
    cases.push_back(c);
  }
  {
    Case c = clean("clean_servo_noisy", "servo", "irregular", "mixed", 50, 30);
    c.loop = {"pd", 2000, 4, 0.9, 40, 0};
    c.instruments.log_hz = 500, c.instruments.counts_per_unit = encoder_bits(14);
    c.instruments.coloured = 0.05, c.instruments.white = 0.03, c.instruments.mean_torque = true;
    cases.push_back(c);
  }
  return cases;
}

}  // namespace stranger
