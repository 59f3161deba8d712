#include "servo/record_set.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <fstream>
#include <stdexcept>

#include "servo/laws.hpp"

namespace servo {
namespace {

constexpr char const* job_of_sets = R"([[recordings]]
manifest = "manifest.csv"

[recording]
columns = {time = "t_s", reference = "q_goal_rad", position = "q_rad", enabled = "torque_enabled"}

[known]
gravity_moment = "9.80665 * mass_kg * length_m"
inertia = "mass_kg * length_m * length_m"
command_gain = "0.165 * kp * supply_v"
command_limit = "0.97 * supply_v"
arm_length = "length_m"

[model]
joint = "revolute"
terms = ["inertia", "viscous", "coulomb"]

[loop]
drive = "voltage"
rate_hz = 1000

[diagnose]
effects = "all"
)";

std::string text(double x, int digits) {
  char words[32];
  std::snprintf(words, sizeof words, "%.*g", digits, x == 0.0 ? 0.0 : x);  // no -0
  return words;
}
std::string number(double x) { return text(x, 10); }

std::string file_name(Setting const& setting, std::string const& motion, int index) {
  // motions beyond the first of each kind have a number
  std::string const again = index >= n_kinds ? "_" + std::to_string(index / n_kinds + 1) : "";
  return "m" + number(setting.mass_kg) + "_l" + number(std::round(1e3 * setting.length_m)) + "_kp" +
         number(setting.kp) + "_" + motion + again + ".csv";
}

class File {
 public:
  explicit File(std::filesystem::path path) : path_(std::move(path)), out_(path_) {}
  template <class T>
  File& operator<<(T const& words) {
    out_ << words;
    return *this;
  }
  void close() {
    out_.close();
    if (!out_) throw std::runtime_error("cannot write " + path_.string());
  }

 private:
  std::filesystem::path path_;
  std::ofstream out_;
};

void write_recording(RecordSet const& set, Entry const& entry, std::filesystem::path const& folder) {
  Recording const made = record(set.servo, entry.setting, entry.samples);
  File out{folder / entry.file};
  out << "t_s,q_goal_rad,q_rad,torque_enabled\n";
  for (std::size_t k = 0; k < entry.samples.size(); ++k) {
    Sample const& sample = entry.samples[k];
    out << text(sample.time, 8) << ',' << text(sample.goal, 8) << ',' << text(made.read[k], 5) << ','
        << (sample.is_on ? '1' : '0') << '\n';
  }
  out.close();
}

void write_manifest(RecordSet const& set, std::filesystem::path const& folder) {
  File out{folder / "manifest.csv"};
  out << "file,role,mass_kg,length_m,kp,supply_v,motion\n";
  for (Entry const& entry : set.entries) {
    Setting const& setting = entry.setting;
    out << entry.file << ',' << entry.role << ',' << number(setting.mass_kg) << ',' << number(setting.length_m) << ','
        << number(setting.kp) << ',' << number(setting.supply_v) << ',' << entry.motion << '\n';
  }
  out.close();
}

void write_truth(SetOptions const& options, RecordSet const& set, std::filesystem::path const& folder) {
  ServoNumbers const& servo = set.servo;
  File out{folder / "truth.json"};
  out << "{\"seed\": " << options.seed << ",\n \"servo\": {\"inertia\": " << number(servo.inertia)
      << ", \"viscous\": " << number(servo.viscous) << ", \"coulomb\": " << number(servo.coulomb)
      << ", \"motor_gain\": " << number(servo.motor_gain) << ", \"back_emf\": " << number(servo.back_emf) << "},\n"
      << " \"laws\": [";
  char const* between = "";
  for (Law const& law : laws) {
    if (std::find(options.with.begin(), options.with.end(), law.name) == options.with.end()) continue;
    bool const has_speed = law.number == &ServoNumbers::stribeck_friction || law.number == &ServoNumbers::load_stribeck;
    out << between << "\n  {\"name\": \"" << law.name << "\", \"number\": " << number(servo.*law.number)
        << (has_speed ? ", \"stribeck_speed\": " + number(servo.stribeck_speed) : "")
        << ", \"effect_mrad\": " << text(1e3 * effect_rad(set, law.name), 3) << "}";
    between = ",";
  }
  out << "]}\n";
  out.close();
}

}  // namespace

RecordSet draw_set(SetOptions const& options) {
  RecordSet set;
  double heaviest = 0.0, longest = 0.0;
  for (auto const* masses : {&options.masses, &options.validation_masses})
    for (double mass : *masses) heaviest = std::max(heaviest, mass);
  for (double length : options.lengths) longest = std::max(longest, length);
  Setting const worst{heaviest, longest, options.kps.front(), options.supply_v};
  set.servo = draw_servo(options.seed, options.with, worst);

  auto add = [&](std::string const& role, double mass) {
    for (double length : options.lengths)
      for (double kp : options.kps)
        for (int index = 0; index < options.motions; ++index) {
          Setting const setting{mass, length, kp, options.supply_v};
          auto const motion = to_text(static_cast<Kind>(index % n_kinds));
          MotionOptions const drawn{options.seed, options.duration_s, options.jitter_s};
          set.entries.push_back({file_name(setting, motion, index), role, motion, setting,
                                 draw_motion(drawn, index, set.entries.size())});
        }
  };
  for (double mass : options.masses) add("train", mass);
  for (double mass : options.validation_masses) add("validate", mass);
  return set;
}

double effect_rad(RecordSet const& set, std::string const& law) {
  ServoNumbers without = set.servo;
  Law const& gone = law_named(law);
  without.*gone.number = gone.without;
  double sum = 0.0;
  std::size_t samples = 0;
  for (Entry const& entry : set.entries) {
    Recording const with_it = record(set.servo, entry.setting, entry.samples);
    Recording const without_it = record(without, entry.setting, entry.samples);
    for (std::size_t k = 0; k < entry.samples.size(); ++k)
      sum += std::abs(with_it.position[k] - without_it.position[k]);
    samples += entry.samples.size();
  }
  return sum / static_cast<double>(samples);
}

void write_set(SetOptions const& options, std::filesystem::path const& folder) {
  RecordSet const set = draw_set(options);
  std::filesystem::create_directories(folder);
  for (Entry const& entry : set.entries) write_recording(set, entry, folder);
  write_manifest(set, folder);
  write_truth(options, set, folder);
  File job{folder / "job.toml"};
  job << "[experiment]\nname = \"servo\"\nseed = " << options.seed << "\n\n" << job_of_sets;
  job.close();
}

}  // namespace servo
