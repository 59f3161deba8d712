#include "concealed_arms/case_files.hpp"

#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace concealed_arms {
namespace {

void write(std::filesystem::path const& path, std::string const& text) {
  std::ofstream file(path, std::ios::binary);
  if (!(file << text).flush()) throw std::runtime_error("cannot write " + path.string());
}

template <typename... Values>
std::string printed(char const* format, Values... values) {
  char text[160];
  std::snprintf(text, sizeof text, format, values...);
  return text;
}

std::string csv(ArmRecording const& recording) {
  std::string text = "t_s";
  auto const joints = recording.torque.rows();
  for (int j = 1; j <= joints; ++j) text += printed(",q_ref%d_rad,q%d_rad,tau%d_Nm", j, j, j);
  text += '\n';
  for (Eigen::Index row = 0; row < recording.torque.cols(); ++row) {
    text += printed("%.4f", static_cast<double>(row) * log_every * control_s);
    for (Eigen::Index j = 0; j < joints; ++j)
      text += printed(",%.9f,%.9f,%.6f", recording.run.reference(j, row), recording.run.seen(j, row),
                      recording.torque(j, row));
    text += '\n';
  }
  return text;
}

// kinematics, limits and encoders: what a maker says of his arm
std::string robot(Arm const& arm) {
  std::string text = printed("[robot]\nname = \"%s\"\nconvention = \"%s\"\ngravity = [0.0, 0.0, -9.81]\n",
                             arm.name.c_str(), arm.standard_dh ? "standard_dh" : "modified_dh");
  for (Link const& link : arm.links) {
    text += printed("\n[[joint]]\nname = \"%s\"\na_m = %.17g\nalpha_rad = %.17g\n", link.name, link.a, link.alpha);
    text += printed("d_m = %.17g\noffset_rad = %.17g\n", link.d, link.offset);
    text += printed("lower = %.4f\nupper = %.4f\nmax_speed = %.4f\n", link.lower, link.upper, link.max_speed);
    text += printed("max_acceleration = %.4f\nencoder_counts = %.0f\n", link.max_acceleration, link.counts);
  }
  return text;
}

char const* const job = R"([experiment]
name = "concealed_arm"
seed = 7

[recording]
train = "train.csv"
validate = "unseen.csv"
columns = {time = "t_s", reference = "q_ref{j}_rad", position = "q{j}_rad", torque = "tau{j}_Nm"}

[filter]
cutoff_hz = 20
parallel_cutoff_hz = 10
decimate_to_hz = 50

[model]
robot = "robot.toml"
friction = ["viscous", "coulomb", "offset"]
drive_inertia = true

[diagnose]
effects = "all"
twins = )";

// a name needs p below 0.05 / joints, and n replicates show no p below 1 / (n + 1)
constexpr int replicates_a_joint = 24;

std::vector<double> numbers(Eigen::VectorXd const& values) { return {values.begin(), values.end()}; }

void describe_law(nlohmann::ordered_json& truth, Law const& law) {
  LawWords const& words = words_of(law.kind);
  bool const of_arm = law.kind == LawKind::tilted_base;
  truth["law"] = words.name;
  truth["families"] = words.families;
  truth["joint"] = of_arm ? 0 : law.joint + 1;  // 0: of the whole arm
  truth["size"] = law.size;
  truth["largest"] = law.largest;
  truth["shape"] = {law.shape, law.second};
  truth["may_name"] = {words.name};
}

void describe_decoy(nlohmann::ordered_json& truth, Decoy const& decoy) {
  truth["joint"] = decoy.joint + 1;
  truth["may_name"] = nlohmann::json::array();
  switch (decoy.kind) {
    case DecoyKind::late:
      truth["decoy"] = "late";
      truth["late_rows"] = decoy.rows;
      truth["may_name"] = {"delay", "actuator_lag"};  // what a late channel is, in words of the catalogue
      break;
    case DecoyKind::swapped:
      truth["decoy"] = "swapped";
      truth["other"] = decoy.other + 1;
      break;
    case DecoyKind::scaled:
      truth["decoy"] = "scaled";
      truth["scale"] = decoy.scale;
      break;
  }
}

std::string truth_text(MadeCase const& made) {
  constexpr char const* kinds[] = {"clean", "law", "decoy"};
  ArmCase const& one = made.of;
  nlohmann::ordered_json truth = {{"schema", 1},
                                  {"case", one.name},
                                  {"kind", kinds[static_cast<int>(one.kind)]},
                                  {"arm", one.plant.arm.name},
                                  {"joints", one.plant.arm.joints()},
                                  {"motion", one.motion == MotionKind::sines ? "sines" : "moves"},
                                  {"log", one.averaged_log ? "averaged" : "applied"}};
  double snr = made.left.largest_snr();
  if (one.plant.law) {
    describe_law(truth, *one.plant.law);
    if (!one.plant.law->is_of_several_joints()) snr = made.left.snr(one.plant.law->joint);
  }
  if (one.kind == CaseKind::decoy) describe_decoy(truth, one.decoy);
  truth["wanted_snr"] = one.wanted_snr;
  truth["snr"] = snr;  // after absorption; of a clean arm: what the plant's steps leave
  truth["residual_rms_Nm"] = numbers(made.left.residual_rms);
  truth["noise_rms_Nm"] = numbers(made.left.noise_rms);
  truth["torque_rms_Nm"] = numbers(made.left.torque_rms);
  return truth.dump(1) + "\n";
}

}  // namespace

void write_case(MadeCase const& made, std::filesystem::path const& folder) {
  std::filesystem::create_directories(folder);
  write(folder / "train.csv", csv(made.train));
  write(folder / "unseen.csv", csv(made.validate));
  write(folder / "robot.toml", robot(made.of.plant.arm));
  write(folder / "job.toml", job + printed("%d\n", replicates_a_joint * made.of.plant.arm.joints()));
  write(folder / "truth.json", truth_text(made));
}

}  // namespace concealed_arms
