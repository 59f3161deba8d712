#include "engine/workflows/results/arm_export.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/base/dense_solvers.hpp"
#include "engine/base/error.hpp"
#include "engine/robot/consistency.hpp"
#include "engine/robot/pseudo_inertia.hpp"
#include "engine/robot/robot_writers.hpp"
#include "engine/workflows/results/robot_tables.hpp"

namespace torquescope {
namespace {

using Eigen::Index;

void expect(bool holds, ResultReader const& reader, std::string const& what) {
  validate(holds, [&] {
    return Problem{.code = ExitCode::bad_data,
                   .what = fmt::format("{} {}", reader.name().string(), what),
                   .help = "export takes a result of torquescope run whose job has [model] robot = \"...\""};
  });
}

// sum over joints of the products of their columns, over the noise
Eigen::MatrixXd information_of(ResultReader const& reader, std::size_t joints) {
  auto const noise = reader.numbers("/arm/noise").values;
  expect(noise.size() == joints, reader, "has no noise of every joint");
  Eigen::MatrixXd sum;
  for (std::size_t j = 0; j < joints; ++j) {
    std::string const group = fmt::format("/arm/joint_{}", j + 1);
    auto const own = reader.whole_numbers(group + "/parameters").values;
    auto const gram = reader.numbers(group + "/gram");
    std::size_t const n = own.size() + 1;
    expect(noise[j] > 0.0 && gram.values.size() == n * n, reader, "has a Gram of another size");
    for (std::size_t a = 0; a < own.size(); ++a) {
      expect(own[a] >= 0 && own[a] < 100000, reader, "numbers a parameter that there is not");
      if (own[a] >= sum.rows()) sum.conservativeResizeLike(Eigen::MatrixXd::Zero(own[a] + 1, own[a] + 1));
    }
    for (std::size_t a = 0; a < own.size(); ++a)
      for (std::size_t b = 0; b < own.size(); ++b)
        sum(own[a], own[b]) += gram.values[a * n + b] / (noise[j] * noise[j]);
  }
  return sum;
}

// of the base parameters, whatever the others are: the Schur complement, of unit columns
Eigen::MatrixXd base_root(Eigen::MatrixXd const& information, Index p) {
  Index const others = information.rows() - p;
  Eigen::VectorXd const lengths = information.diagonal().cwiseSqrt();
  Eigen::MatrixXd const unit = lengths.cwiseInverse().asDiagonal() * information * lengths.cwiseInverse().asDiagonal();
  Eigen::MatrixXd schur = unit.topLeftCorner(p, p);
  if (others > 0)
    schur -= unit.topRightCorner(p, others) *
             solve_positive(unit.bottomRightCorner(others, others), Eigen::MatrixXd(unit.bottomLeftCorner(others, p)));
  auto const factor = cholesky_of(schur);
  validate(factor.has_value(), [] {
    return Problem{.code = ExitCode::bad_data,
                   .what = "the recordings of this result cannot tell its base parameters apart",
                   .help = "record a motion that moves every joint, and identify again"};
  });
  return factor->lower().transpose() * lengths.head(p).asDiagonal();
}

// "motor 6 turns by q6 + 0.5 q5", of coupled drives: no robot file has a place for it
std::vector<std::string> drive_words(SerialChain const& chain) {
  std::vector<std::string> words;
  for (Index m = 0; m < chain.size(); ++m) {
    if (!chain.is_coupled(m)) continue;
    std::string text = fmt::format("Motor {0} turns by q{0}", m + 1);
    for (Index j = 0; j < chain.size(); ++j)
      if (double const turns = chain.transmission(m, j); j != m && turns != 0.0)
        text += fmt::format(" {} {:g} q{}", turns < 0.0 ? "-" : "+", std::abs(turns), j + 1);
    words.push_back(text + ": its inertia and friction are those at that angle.");
  }
  return words;
}

std::string listed(std::vector<std::string> const& names) { return fmt::format("{}", fmt::join(names, ", ")); }

// which of the standard parameters are identified as they are, within sums, not at all
std::vector<std::string> words_of(BaseParameters const& base) {
  std::vector<std::string> alone, sums;
  std::vector<bool> is_alone(static_cast<std::size_t>(base.standard_size()), false);
  for (auto const& parameter : base.parameters())
    is_alone[static_cast<std::size_t>(parameter.column)] = parameter.gathers.empty();
  auto const& without = base.without_effect();
  for (std::size_t k = 0; k < is_alone.size(); ++k) {
    auto const& name = base.standard_names()[k];
    if (std::find(without.begin(), without.end(), name) == without.end()) (is_alone[k] ? alone : sums).push_back(name);
  }
  std::vector<std::string> words;
  if (!alone.empty()) words.push_back("Identified as they are: " + listed(alone) + ".");
  if (!sums.empty())
    words.push_back("Only sums of these are identified, each value is chosen among bodies: " + listed(sums) + ".");
  if (!without.empty()) words.push_back("No torque depends on these, they are chosen: " + listed(without) + ".");
  return words;
}

InertiaPrior prior_of_file(SerialChain const& chain) {
  validate(chain.has_inertias(), [] {
    return Problem{.code = ExitCode::usage,
                   .what = "the robot file of this result has no inertias to stay near to",
                   .help = "leave --cad out, or write masses and inertias into it and run the job again"};
  });
  InertiaPrior prior;
  prior.links = chain.links;
  for (auto const& joint : chain.joints) prior.drives.push_back(joint.drive_inertia);
  for (std::size_t i = 0; i < chain.links.size(); ++i) {
    std::string const fault = prior_fault(chain.links[i]);
    validate(fault.empty(), [&] {
      return Problem{.code = ExitCode::usage,
                     .what = fmt::format("link {} of the robot file is no body: {}", i + 1, fault),
                     .help = "leave --cad out, or correct its inertias and run the job again"};
    });
  }
  return prior;
}

}  // namespace

IdentifiedArm read_identified_arm(ResultReader const& reader) {
  expect(reader.exists("/robot") && reader.exists("/arm"), reader, "is no result of an arm");
  IdentifiedArm arm;
  auto const robot = read_robot_tables(reader);
  auto const& chain = robot.chain;
  arm.information = information_of(reader, chain.joints.size());
  auto const names = reader.texts("/robot/base_parameters");
  bool found = false;
  for (auto const drives : {DriveInertias::included, DriveInertias::left_out}) {
    BaseParameters const base(chain, drives);
    bool const same = std::equal(names.begin(), names.end(), base.parameters().begin(), base.parameters().end(),
                                 [](auto const& name, auto const& parameter) { return name == parameter.name; });
    if (!same || found) continue;
    arm.drives = drives;
    found = true;
  }
  expect(found && arm.information.rows() >= static_cast<Index>(names.size()), reader,
         "has other base parameters than its arm");
  if (reader.exists("/robot/shapes")) {
    auto const shapes = reader.texts("/robot/shapes");
    auto const values = reader.numbers("/robot/shape_values").values;
    for (std::size_t k = 0; k < std::min(shapes.size(), values.size()); ++k)
      arm.effect_words.push_back(fmt::format("{} = {:.6g}", shapes[k], values[k]));
  }
  arm.chain = chain;
  arm.has_limits = robot.has_limits;
  return arm;
}

std::vector<ExportFormat> export_formats() {
  std::vector<ExportFormat> formats;
  for (auto const& writer : robot_writers()) formats.push_back({writer.name, writer.meaning});
  return formats;
}

Eigen::VectorXd read_standard_parameters(ResultReader const& reader, std::string const& estimator) {
  std::string const path = fmt::format("/runs/{}/standard_parameters", estimator);
  if (!reader.exists(path)) return {};
  auto const values = reader.numbers(path).values;
  return Eigen::VectorXd::Map(values.data(), static_cast<Index>(values.size()));
}

namespace {

// bodies, and how far from the estimate they are
struct ArmBodies {
  Eigen::VectorXd standard;
  double distance = 0.0;
  std::string words;
};

ArmBodies bodies_of(IdentifiedArm const& arm, BaseParameters const& base, ArmEstimate const& estimate,
                    NearBodies near) {
  Index const p = base.size();
  if (near == NearBodies::cubes && estimate.standard.size() > 0)
    return {
        estimate.standard, 0.0,
        fmt::format("Identified by Torquescope as bodies, by estimator consistent: {} base parameters are theirs.", p)};
  InertiaPrior prior = near == NearBodies::robot_file ? prior_of_file(arm.chain) : InertiaPrior();
  // costs no more than can be seen, and keeps masses finite that no torque limits
  prior.weight = visible_gap;
  auto const found =
      consistent_parameters(arm.chain, base, {estimate.values.head(p), base_root(arm.information, p)}, prior);
  return {found.standard, found.distance,
          fmt::format("Identified by Torquescope: the bodies closest to {} base parameters, {:.3g} standard errors "
                      "away.",
                      p, found.distance)};
}

}  // namespace

ArmExport export_arm(IdentifiedArm const& arm, ArmEstimate const& estimate, std::string const& format,
                     NearBodies near) {
  BaseParameters const base(arm.chain, arm.drives);
  auto const& [names, values, standard] = estimate;
  bool const fits = values.size() == arm.information.rows() &&
                    names.size() == static_cast<std::size_t>(values.size()) &&
                    (standard.size() == 0 || standard.size() == base.standard_size());
  validate(fits, [] {
    return Problem{.code = ExitCode::bad_data, .what = "the parameters of this result do not fit its arm", .help = ""};
  });
  auto const found = bodies_of(arm, base, estimate, near);
  SerialChain chain = arm.chain;
  chain.links.clear();
  for (Index i = 0; i < chain.size(); ++i) {
    chain.links.push_back(LinkInertia::from_vector(found.standard.segment<numbers_per_link>(numbers_per_link * i)));
    if (arm.drives == DriveInertias::included)
      chain.joints[static_cast<std::size_t>(i)].drive_inertia = found.standard[numbers_per_link * chain.size() + i];
  }
  ArmExport out;
  out.distance = found.distance;
  out.notes.push_back(found.words);
  for (auto const& words : words_of(base)) out.notes.push_back(words);
  for (auto const& words : drive_words(chain)) out.notes.push_back(words);
  if (near == NearBodies::robot_file) out.notes.emplace_back("What is chosen is near the robot file's inertias.");
  std::vector<std::string> beside;
  for (Index k = base.size(); k < values.size(); ++k)
    beside.push_back(fmt::format("{} = {:.6g}", names[static_cast<std::size_t>(k)], values[k]));
  beside.insert(beside.end(), arm.effect_words.begin(), arm.effect_words.end());
  if (!beside.empty()) out.notes.push_back("Beside the links: " + listed(beside) + ".");
  for (auto const& writer : robot_writers())
    if (writer.name == format) out.text = writer.write(chain, out.notes);
  return out;
}

}  // namespace torquescope
