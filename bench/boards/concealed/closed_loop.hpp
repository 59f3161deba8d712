#pragma once
// A rig, its effects and a motion make a recording, and beside it the truth that no recording has.
//
// Tick k     begins at t_k (1 kHz and the clock's jitter): the encoder is read, the command computed from reading k-1
//            takes effect and is held, the current is read. Row k = (t_k, reference, reading, current reading)
// Threads    free function

#include <cstdint>
#include <vector>

#include "concealed/rig.hpp"

namespace concealed {

inline constexpr double tick_s = 1e-3, default_step_s = 20e-6;
// of the peak speed: below it a recording does not tell creeping, presliding and rest apart
inline constexpr double slowest_share = 0.005;

// one value per tick
struct Recording {
  std::vector<double> time, reference, position, torque;
};

// the middle of each tick, where the held torque belongs
struct Truth {
  std::vector<double> t, q, v, a;
  std::vector<double> seen_q, seen_v, seen_a;  // as the encoder would show them without steps
  std::vector<double> seen_motor;              // as the torque channel would show it without noise
  std::vector<double> motor, disturbance;      // held during the tick
  std::vector<char> moves;                     // in one direction, not slower than slowest_share, all the tick long
  std::vector<std::vector<double>> added;      // per effect, then per instrument: torque it adds to the baseline's
  std::vector<double> coulomb_factor;
};

struct LoopRun {
  Recording recording;
  Truth truth;
};

struct RunPlan {
  Excitation const& excitation;
  double duration_s = 0.0;
  std::uint64_t seed = 0;
  double step_s = default_step_s;  // at most; a tick is divided into an even number of equal steps
};

LoopRun run_closed_loop(Rig const& rig, HiddenEffects const& effects, RunPlan const& plan);

// the same rig with perfect instruments and nothing from outside
Rig without_noise(Rig rig);

}  // namespace concealed
