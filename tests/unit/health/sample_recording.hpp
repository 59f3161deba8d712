#pragma once
// Recordings of a joint as a test draws them: a motion of several sines, friction and inertia, an encoder, noise.
//
// Shares no code with the engine's simulation

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "engine/data/recording_reader.hpp"

namespace torquescope::health_test {

struct Drawn {
  double rate_hz = 500.0, seconds = 12.0, amplitude = 0.9, encoder_step = 2e-5, noise = 0.02;
  unsigned seed = 1;
};

// columns t_s, q_rad, tau_Nm, qd_radps; line of a row is its number + 2
inline RawTable sample_table(Drawn const& drawn = {}) {
  std::mt19937 engine(drawn.seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform(0.0, 6.283185307179586);
  double const phase1 = uniform(engine), phase2 = uniform(engine), w1 = 2.1 + 0.3 * uniform(engine) / 6.28, w2 = 5.3;
  RawTable table;
  table.path = "/data/sample.csv";
  table.sha256 = "abc";
  table.names = {"t_s", "q_rad", "tau_Nm", "qd_radps"};
  table.columns.resize(4);
  auto const n = static_cast<std::size_t>(drawn.seconds * drawn.rate_hz);
  for (std::size_t i = 0; i < n; ++i) {
    double const t = static_cast<double>(i) / drawn.rate_hz;
    double const q = drawn.amplitude * (std::sin(w1 * t + phase1) + 0.4 * std::sin(w2 * t + phase2));
    double const dq = drawn.amplitude * (w1 * std::cos(w1 * t + phase1) + 0.4 * w2 * std::cos(w2 * t + phase2));
    double const ddq =
        -drawn.amplitude * (w1 * w1 * std::sin(w1 * t + phase1) + 0.4 * w2 * w2 * std::sin(w2 * t + phase2));
    double const torque = 0.09 * ddq + 0.35 * dq + 0.6 * std::tanh(dq / 0.01) + 0.04 + drawn.noise * normal(engine);
    table.columns[0].push_back(t);
    table.columns[1].push_back(drawn.encoder_step > 0.0 ? drawn.encoder_step * std::round(q / drawn.encoder_step) : q);
    table.columns[2].push_back(torque);
    table.columns[3].push_back(dq);
    table.line_of_row.push_back(static_cast<std::int64_t>(i) + 2);
  }
  return table;
}

inline RecordingOptions sample_options(bool with_velocity = false) {
  RecordingOptions options;
  options.columns = {{"time", "t_s"}, {"position", "q_rad"}, {"torque", "tau_Nm"}};
  if (with_velocity) options.columns["velocity"] = "qd_radps";
  return options;
}

}  // namespace torquescope::health_test
