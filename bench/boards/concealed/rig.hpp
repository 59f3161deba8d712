#pragma once
// A test bench in numbers: joint, loop, instruments, noises. Named ones are in rig_library.cpp.
//
// Units      SI of the joint; noises as shares of the joint's Coulomb friction

#include <string>

#include "concealed/controller.hpp"
#include "concealed/excitation.hpp"
#include "concealed/instrument.hpp"
#include "concealed/plant.hpp"

namespace concealed {

struct JointDesign {
  std::string name;
  bool revolute = true;
  Baseline baseline;
  MotionLimits limits;
  double torque_limit = 0.0;
  double travel_per_turn = 0.0;  // of the encoder: 2 pi, or the lead of a screw
};

struct NoiseLevel {
  std::string name;
  double white = 0.0, coloured = 0.0;  // of the current reading; coloured with a memory of 8 ms
  double disturbance = 0.0;            // torque from outside, memory 30 ms
  double friction_wander = 0.0;        // of the Coulomb level, memory 20 s
  double clock_jitter = 0.0;           // rms of a tick's start, share of a tick
  int converter_bits = 0;              // of the current reading; 0: exact
};

struct Rig {
  JointDesign joint;
  ControllerDesign controller;
  NoiseLevel noise;
  int encoder_bits = 0;         // per turn; 0: exact
  int noisy_bits = 0;           // the last of them say nothing
  bool nominal_stamps = false;  // rows are written at the nominal times of their ticks
  Instruments instruments = {};
};

JointDesign joint_named(std::string const& name);            // elbow, wrist, shoulder, stage, base, belt
ControllerDesign controller_named(std::string const& name);  // pd, pid, cascade, soft_pd, stiff_cascade
NoiseLevel noise_named(std::string const& name);             // none, quiet, bench, workshop

}  // namespace concealed
