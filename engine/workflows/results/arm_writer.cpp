#include "engine/workflows/results/arm_writer.hpp"

#include <algorithm>
#include <limits>
#include <span>

#include "engine/diagnose/arms/effect_shapes.hpp"
#include "engine/experiment/arm_findings.hpp"
#include "engine/fit/problem/arm_accuracy.hpp"
#include "engine/robot/gather_text.hpp"
#include "engine/store/scale_datasets.hpp"
#include "engine/workflows/results/robot_tables.hpp"

namespace torquescope {
namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

std::string joint_group(std::string const& group, std::size_t joint) {
  return group + "/joint_" + std::to_string(joint + 1);
}

void write_matrix(ResultWriter& writer, std::string const& path, RowMajor const& matrix, Note const& note) {
  auto const rows = static_cast<std::size_t>(matrix.rows()), columns = static_cast<std::size_t>(matrix.cols());
  writer.numbers(path, {rows, columns}, {matrix.data(), rows * columns}, note);
}

void write_vector(ResultWriter& writer, std::string const& path, Eigen::VectorXd const& vector, Note const& note) {
  auto const n = static_cast<std::size_t>(vector.size());
  writer.numbers(path, {n}, {vector.data(), n}, note);
}

// NaN where a drive inertia that the file does not give is in the sum
Eigen::VectorXd values_of_file(SerialChain const& chain, BaseParameters const& base, DriveInertias drives) {
  Eigen::VectorXd standard = standard_parameters(chain, drives);
  if (drives == DriveInertias::included)
    for (auto k = numbers_per_link * chain.size(); k < standard.size(); ++k)
      if (standard[k] == 0.0) standard[k] = std::numeric_limits<double>::quiet_NaN();
  Eigen::VectorXd values(base.size());
  for (Eigen::Index k = 0; k < base.size(); ++k) {
    auto const& parameter = base.parameters()[static_cast<std::size_t>(k)];
    values[k] = standard[parameter.column];
    for (auto const& term : parameter.gathers) values[k] += term.factor * standard[term.column];
  }
  return values;
}

std::vector<std::string> joint_names(SerialChain const& chain) {
  std::vector<std::string> names;
  for (auto const& joint : chain.joints) names.push_back(joint.name);
  return names;
}

// effects beside the rigid arm: their shapes; what is linear in them stands among the parameters
void write_effects(ResultWriter& writer, ArmModel const& model) {
  std::vector<std::string> names;
  std::vector<double> values;
  for (auto const& effect : model.effects())
    for (std::size_t k = 0; k < effect.shape.size(); ++k) {
      names.push_back(shape_name(effect, k));
      values.push_back(effect.shape[k]);
    }
  if (names.empty()) return;
  writer.texts("/robot/shapes", names,
               {"1", "shapes of the effects of [[model.effects]], with the number of their joint"});
  writer.numbers("/robot/shape_values", {values.size()}, values, {"SI", "their values, refined in the fit"});
}

void write_robot(ResultWriter& writer, ArmParts const& arm) {
  auto const& chain = arm.model.chain();
  auto const& base = arm.model.base();
  std::vector<std::string> parameters, units, gathers;
  for (Eigen::Index k = 0; k < base.size(); ++k) {
    auto const& parameter = base.parameters()[static_cast<std::size_t>(k)];
    parameters.push_back(parameter.name);
    units.push_back(parameter.unit);
    gathers.push_back(gather_text(base, k));
  }
  write_robot_tables(writer, chain);
  write_effects(writer, arm.model);
  writer.attribute("/robot", "file", arm.robot_file);
  writer.attribute("/robot", "sha256", arm.sha256);
  write_names(writer, "/robot", "parameter", parameters);
  writer.texts("/robot/base_parameters", parameters, Note{"1", "base parameters"}.over({"parameter"}));
  writer.texts("/robot/base_units", units, Note{"1", "their units"}.over({"parameter"}));
  writer.texts("/robot/gathers", gathers, Note{"1", "standard parameters that each is the sum of"}.over({"parameter"}));
  if (chain.has_inertias())
    write_vector(writer, "/robot/file_values", values_of_file(chain, base, arm.model.drives()),
                 Note{"SI", "base parameters of the robot file's inertias; NaN where it gives no drive inertia"}.over(
                     {"parameter"}));
}

void write_joint_errors(ResultWriter& writer, std::string const& group, std::string const& prefix,
                        ArmAccuracy const& accuracy) {
  std::vector<double> relerr, all_rows, rms;
  for (auto const& joint : accuracy.joints) {
    relerr.push_back(joint.relerr());
    all_rows.push_back(joint.relerr_all_rows());
    rms.push_back(joint.residual_rms());
  }
  auto const write = [&](char const* name, std::vector<double> const& values, Note const& note) {
    writer.numbers(group + "/" + prefix + name, {values.size()}, values, note.over({"joint"}));
  };
  write("joint_relerr", relerr, {"1", "relative error of each joint, rows that move one way"});
  write("joint_relerr_all_rows", all_rows, {"1", "relative error of each joint, all rows"});
  write("joint_residual_rms", rms, {"N m or N", "residual of each joint, rows that move one way"});
  writer.attribute(group, prefix + "relerr_all_rows", accuracy.arm.relerr_all_rows());
}

}  // namespace

void write_arm(ResultWriter& writer, Experiment::Parts const& parts) {
  auto const& arm = *parts.arm;
  write_robot(writer, arm);
  writer.attribute("/arm", "joints", static_cast<std::int64_t>(arm.model.joints()));
  writer.attribute("/arm", "noise_iterations", std::int64_t{arm.noise.iterations});
  write_vector(writer, "/arm/noise", arm.noise.deviation,
               Note{"N m or N", "noise of each joint: rows are divided by it"}.over({"joint"}));
  write_names(writer, "/arm", "joint", joint_names(arm.model.chain()));
  std::vector<std::string> seen;
  for (auto const one : arm_identifiability(parts).seen) seen.push_back(word(one));
  writer.texts("/arm/seen", seen, Note{"1", "how the training rows tell each parameter"}.over({"parameter"}));
  write_names(writer, "/arm", "parameter", parts.parameter_names());
  for (std::size_t j = 0; j < arm.grams.size(); ++j) {
    auto const& gram = arm.grams[j];
    std::string const group = joint_group("/arm", j);
    std::vector<std::int64_t> const own(gram.parameters.begin(), gram.parameters.end());
    writer.whole_numbers(group + "/parameters", {own.size()}, own, {"1", "parameters of this joint's rows"});
    write_matrix(writer, group + "/gram", gram.gram, {"SI", "products of its columns and torque, training rows"});
    writer.attribute(group, "rows", static_cast<std::int64_t>(gram.rows));
    writer.attribute(group, "unit_torque", arm.model.torque_unit(j));
  }
}

void write_arm_samples(ResultWriter& writer, std::string const& group, DataSet const& set,
                       Experiment::Parts const& parts) {
  auto const& rows = set.regression;
  auto const& model = parts.arm->model;
  writer.attribute(group, "samples", static_cast<std::int64_t>(rows.rows()));
  writer.attribute(group, "samples_all_rows", static_cast<std::int64_t>(rows.rows() + set.other_rows.rows()));
  if (!parts.output.samples) return;
  auto const names = parts.parameter_names();
  for (std::size_t j = 0; j < model.joints(); ++j) {
    std::vector<Eigen::Index> own;
    std::vector<std::int64_t> recording;
    for (std::size_t k = 0; k < rows.recordings(); ++k) {
      if (rows.arm->joint[k] != j) continue;
      for (Eigen::Index t = rows.first_row[k]; t < rows.first_row[k + 1]; ++t) {
        own.push_back(t);
        recording.push_back(static_cast<std::int64_t>(k / model.joints()));
      }
    }
    std::string const path = joint_group(group, j);
    bool const revolute = model.chain().joints[j].kind == JointKind::revolute;
    std::string const length = revolute ? "rad" : "m";
    double const noise = parts.arm->noise.deviation[static_cast<Eigen::Index>(j)];
    write_vector(writer, path + "/time", rows.time_s(own), Note{"s", "time"}.over({"time"}));
    writer.whole_numbers(path + "/recording", {recording.size()}, recording,
                         Note{"1", "index of the recording"}.over({"time"}));
    write_vector(writer, path + "/position", rows.q(own), Note{length, "position"}.over({"time"}));
    write_vector(writer, path + "/velocity", rows.dq(own), Note{length + "/s", "velocity"}.over({"time"}));
    write_vector(writer, path + "/acceleration", rows.ddq(own), Note{length + "/s2", "acceleration"}.over({"time"}));
    write_vector(writer, path + "/torque", noise * rows.tau(own), Note{model.torque_unit(j), "torque"}.over({"time"}));
    write_matrix(writer, path + "/regressor", noise * rows.phi(own, model.parameters_of(j)),
                 Note{"SI", "columns of the joint's own parameters"}.over({"time", "parameter"}));
    std::vector<std::string> labels;
    for (Eigen::Index const column : model.parameters_of(j)) labels.push_back(names[static_cast<std::size_t>(column)]);
    write_names(writer, path, "parameter", labels);
    writer.plottable(path, "torque", {"time"});
  }
}

void write_arm_accuracy(ResultWriter& writer, std::string const& label, Experiment::Parts const& parts,
                        RunResults const& results) {
  auto const present = results.present();
  if (present.empty()) return;
  RunResults const some = results.only(present);
  auto const& parameters = some.parameters[lower_median_index(some.gap)];
  std::string const group = "/runs/" + label;
  write_names(writer, group, "joint", joint_names(parts.arm->model.chain()));
  write_joint_errors(writer, group, "", arm_accuracy(parts.train.regression, parts.train.other_rows, parameters));
  if (parts.validate)
    write_joint_errors(writer, group, "validation_",
                       arm_accuracy(parts.validate->regression, parts.validate->other_rows, parameters));
}

}  // namespace torquescope
