#include "concealed/case_writer.hpp"

#include <array>
#include <cstdio>
#include <fstream>
#include <stdexcept>

#include "concealed/sha256.hpp"

namespace concealed {
namespace {

void write(std::filesystem::path const& path, std::string const& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  file.close();
  if (!file) throw std::runtime_error("cannot write " + path.string());
}

std::string csv_text(Rig const& rig, Recording const& recording) {
  std::string text = rig.joint.revolute ? "t_s,q_ref_rad,q_rad,tau_Nm\n" : "t_s,q_ref_m,q_m,F_N\n";
  std::array<char, 128> line{};
  for (std::size_t k = 0; k < recording.time.size(); ++k) {
    // the clock counts tenths of a microsecond; positions and torques already come in the instruments' steps
    std::snprintf(line.data(), line.size(), "%.7f,%.12g,%.12g,%.10g\n", recording.time[k], recording.reference[k],
                  recording.position[k], recording.torque[k]);
    text += line.data();
  }
  return text;
}

}  // namespace

std::string job_text(Case const& one_case) {
  JointDesign const& joint = one_case.rig.joint;
  std::string const columns = joint.revolute
                                  ? R"({time = "t_s", reference = "q_ref_rad", position = "q_rad", torque = "tau_Nm"})"
                                  : R"({time = "t_s", reference = "q_ref_m", position = "q_m", torque = "F_N"})";
  std::string const gravity = joint.baseline.has_gravity() ? ", \"gravity\"" : "";
  auto whole = [](double hz) { return std::to_string(static_cast<int>(hz)); };
  return "[experiment]\nname = \"" + one_case.name +
         "\"\nseed = 1\n\n"
         "[recording]\ntrain = \"train.csv\"\nvalidate = \"validate.csv\"\ncolumns = " +
         columns + "\n\n[filter]\ncutoff_hz = " + whole(position_cutoff_hz) +
         "\nparallel_cutoff_hz = " + whole(parallel_cutoff_hz) + "\ndecimate_to_hz = " + whole(decimate_to_hz) +
         "\n\n[model]\njoint = \"" + (joint.revolute ? "revolute" : "prismatic") +
         "\"\nterms = [\"inertia\", \"viscous\", \"coulomb\", \"offset\"" + gravity +
         "]\n\n[diagnose]\neffects = \"all\"\ntwins = 200\nq = 0.05\nmax_effects = 5\n";
}

std::string write_case(Case const& one_case, CaseReport const& report, std::filesystem::path const& folder) {
  std::filesystem::create_directories(folder);
  std::string const truth = truth_text(one_case, report);
  write(folder / "train.csv", csv_text(one_case.rig, report.train));
  write(folder / "validate.csv", csv_text(one_case.rig, report.validate));
  write(folder / "job.toml", job_text(one_case));
  write(folder / "truth.json", truth);
  return sha256(truth);
}

}  // namespace concealed
