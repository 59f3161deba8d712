#pragma once
// A set of recordings of one servo: every load with every gain and motion, and what is written of it.
//
// Files      *.csv (t_s, q_goal_rad, q_rad, torque_enabled), manifest.csv, job.toml, truth.json

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "servo/recording.hpp"

namespace servo {

struct SetOptions {
  std::uint64_t seed = 1;
  std::vector<std::string> with;                                  // effects
  std::vector<double> masses{0.5, 1.0}, validation_masses{0.75};  // kg
  std::vector<double> lengths{0.1, 0.15}, kps{8.0, 32.0};         // m, firmware units
  double supply_v = 12.0, duration_s = 6.0, jitter_s = 0.0;
  int motions = n_kinds;
};

struct Entry {
  std::string file, role, motion;
  Setting setting;
  std::vector<Sample> samples;
};

struct RecordSet {
  ServoNumbers servo;
  std::vector<Entry> entries;
};

RecordSet draw_set(SetOptions const& options);

// Mean change of the position that an effect makes, over all samples of the entries
double effect_rad(RecordSet const& set, std::string const& law);

void write_set(SetOptions const& options, std::filesystem::path const& folder);

}  // namespace servo
