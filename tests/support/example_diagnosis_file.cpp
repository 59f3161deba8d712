#include "support/example_diagnosis_file.hpp"

#include <cstdint>
#include <vector>

#include "engine/store/result_writer.hpp"
#include "engine/workflows/results/diagnosis_writer.hpp"
#include "support/example_diagnosis.hpp"

namespace torquescope::example {

namespace {

constexpr std::size_t n_parameters = 4;

void write_job(ResultWriter& writer) {
  std::string const text =
      "# INVENTED: no recording was diagnosed for this file\n"
      "[experiment]\nname = \"invented\"\nseed = 7\n\n[diagnose]\ntwins = 200\n";
  writer.texts("/job/text", std::vector<std::string>{text}, {"1", "job file, verbatim"});
  writer.attribute("/job", "name", std::string("invented"));
  writer.attribute("/job", "study", std::string());
  writer.attribute("/job", "seed", std::int64_t{7});
  writer.attribute("/job", "runs", std::int64_t{30});
  writer.attribute("/job", "sha256", std::string(64, 'a'));
  writer.attribute("/job", "inputs_sha256", std::string(64, 'b'));
}

void write_model(ResultWriter& writer, JointDiagnosis const& joint) {
  std::vector<std::string> names, units;
  for (auto const& parameter : joint.baseline) {
    names.push_back(parameter.name);
    units.push_back(parameter.unit);
  }
  writer.texts("/model/names", names, {"1", "parameter names"});
  writer.texts("/model/units", units, {"1", "parameter units"});
  writer.numbers("/model/truth", {names.size()}, std::vector<double>(names.size(), unknown), {"SI", "truth"});
  writer.numbers("/model/lower", {names.size()}, std::vector<double>(names.size(), -1.0), {"SI", "lower end"});
  writer.numbers("/model/upper", {names.size()}, std::vector<double>(names.size(), 1.0), {"SI", "upper end"});
  writer.attribute("/model", "joint", std::string("revolute"));
  writer.attribute("/model", "equation", std::string("tau = J ddq + f_v dq + f_c sign(dq) + c"));
}

void write_data(ResultWriter& writer, std::string const& group, TorqueTrace const& trace,
                std::string const& recording) {
  auto const n = static_cast<std::size_t>(trace.time_s.size());
  auto const numbers = [&](char const* name, Eigen::VectorXd const& values, Note const& note) {
    writer.numbers(group + "/" + name, {n}, {values.data(), n}, note);
  };
  numbers("time", trace.time_s, {"s", "time"});
  writer.whole_numbers(group + "/recording", {n}, std::vector<std::int64_t>(n, 0), {"1", "index of the recording"});
  numbers("position", trace.position, {"rad", "position"});
  numbers("velocity", trace.velocity, {"rad/s", "velocity"});
  Eigen::VectorXd const acceleration = -0.6169 * (trace.position.array() - 0.05).matrix();
  numbers("acceleration", acceleration, {"rad/s2", "acceleration"});
  numbers("torque", trace.torque, {"N m", "torque"});
  Eigen::Matrix<double, Eigen::Dynamic, n_parameters, Eigen::RowMajor> regressor(trace.time_s.size(), n_parameters);
  regressor << acceleration, trace.velocity, trace.velocity.array().sign().matrix(),
      Eigen::VectorXd::Ones(trace.time_s.size());
  writer.numbers(group + "/regressor", {n, n_parameters}, {regressor.data(), n * n_parameters}, {"SI", "regressor"});
  writer.attribute(group, "recordings", std::vector<std::string>{recording});
  writer.attribute(group, "sha256", std::vector<std::string>{std::string(64, 'c')});
  writer.attribute(group, "rate_hz", 1000.0);
  writer.attribute(group, "kept_rate_hz", trace.rate_hz);
  writer.attribute(group, "duration_s", static_cast<double>(n) / trace.rate_hz);
  writer.attribute(group, "simulated", std::int64_t{0});
  writer.attribute(group, "cutoff_hz", 20.0);
  writer.attribute(group, "reversals", std::int64_t{6});
  writer.plottable(group, "torque", {"time"});
}

void write_health(ResultWriter& writer) {
  std::string const group = "/data/regressor_health";
  Eigen::Matrix4d const correlation = Eigen::Matrix4d::Identity();
  writer.numbers(group + "/correlation", {n_parameters, n_parameters}, {correlation.data(), 16}, {"1", "correlation"});
  writer.attribute(group, "condition_number", 4.2);
  writer.attribute(group, "words", std::string());
}

void write_provenance(ResultWriter& writer) {
  std::string const group = "/provenance";
  writer.attribute(group, "started", std::string("2000-01-01T00:00:00Z"));
  writer.attribute(group, "finished", std::string("2000-01-01T00:00:31Z"));
  writer.attribute(group, "seconds", 31.0);
  writer.attribute(group, "host", std::string("nowhere"));
  writer.attribute(group, "threads", std::int64_t{2});
  writer.attribute(group, "threads_reason", std::string("invented"));
  writer.attribute(group, "vector_target", std::string("AVX2"));
  writer.attribute(group, "version", std::string("0.1.0"));
  writer.attribute(group, "compiler", std::string("none"));
  writer.attribute(group, "build_type", std::string("Release"));
}

}  // namespace

std::string write_diagnosis_file(std::filesystem::path const& name, Diagnosis const& diagnosis) {
  ResultWriter writer(name);
  write_job(writer);
  JointDiagnosis const& joint = diagnosis.joints.front();
  write_model(writer, joint);
  // one recording serves them all, whatever the diagnosis kept of it
  TorqueTrace const trace = invented_diagnosis().joints.front().traces.front();
  write_data(writer, "/data/train", trace, "invented_train.csv");
  if (!joint.traces.empty()) write_data(writer, "/data/validate", trace, trace.recording);
  write_health(writer);
  write_diagnosis(writer, diagnosis);
  write_provenance(writer);
  return writer.finish();
}

}  // namespace torquescope::example
