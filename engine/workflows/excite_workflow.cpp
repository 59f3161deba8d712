// `torquescope excite`: the motion from which a job's arm can best be identified, as a file.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "engine/effects/model_options.hpp"
#include "engine/experiment/arm_assembly.hpp"
#include "engine/experiment/arm_motion_file.hpp"
#include "engine/experiment/foreign_file.hpp"
#include "engine/experiment/job/job_options.hpp"
#include "engine/experiment/job_sections.hpp"
#include "engine/experiment/separated_columns.hpp"
#include "engine/fit/excite/excitation_search.hpp"
#include "engine/store/temp_file.hpp"
#include "engine/workflows/workflows.hpp"

namespace torquescope {

namespace {

RowModel row_model(ArmModel const& model, ExciteOptions const& options) {
  RowModel rows;
  rows.size = static_cast<Eigen::Index>(model.size());
  for (std::size_t j = 0; j < model.joints(); ++j) rows.own.push_back(model.parameters_of(j));
  rows.noise = torque_noise(model.chain(), options);
  rows.rows = [&model](MotionSamples const& samples) { return model.rows(joint_motions(samples)); };
  return rows;
}

// simulate.noise.torque_std of an arm, where there is noise at every joint
std::vector<double> simulated_noise(Job const& job) {
  Section const* noise = job.find("simulate.noise");
  Setting const* written = noise != nullptr ? noise->find("torque_std") : nullptr;
  auto const value = written != nullptr ? converted(written->value, OptionValue(std::vector<double>())) : std::nullopt;
  if (!value) return {};
  auto const numbers = std::get<std::vector<double>>(*value);
  bool const is_loud = std::all_of(numbers.begin(), numbers.end(), [](double one) { return one > 0.0; });
  return is_loud ? numbers : std::vector<double>();
}

void require_robot(Job const& job, ModelOptions const& model, std::vector<Problem>& problems) {
  if (!model.robot.empty()) return;
  Problem problem;
  problem.what = "the job has no model.robot: there is no arm to move";
  problem.place.file = job.path.string();
  problem.help = "write [model] robot = \"robots/ROBOT.toml\" and friction = [\"viscous\", \"coulomb\", \"offset\"]";
  problems.push_back(problem);
}

}  // namespace

ExciteReport excite_arm(std::filesystem::path const& job_file, std::filesystem::path const& output, int threads) {
  // what was written
  Job const job = read_job_file(job_file);
  std::vector<Problem> problems;
  check_section_names(job, problems);
  auto const experiment = read_options<ExperimentOptions>(job, problems);
  auto model_options = read_options<ModelOptions>(job, problems);
  model_options.drive_gains = false;  // a motion has no torque
  auto options = read_options<ExciteOptions>(job, problems);
  if (options.torque_noise.empty()) options.torque_noise = simulated_noise(job);
  require_robot(job, model_options, problems);
  if (!problems.empty()) throw Error(std::move(problems));
  ArmParts const arm = read_arm(job, model_options);
  SerialChain const& chain = arm.model.chain();
  Section const excite = section_or_empty(job, "excite");
  check_excite(options, chain.joints.size(), excite, problems);
  RowModel const rows = with_separated(row_model(arm.model, options), arm.model, options, excite, problems);
  if (!problems.empty()) throw Error(std::move(problems));

  // the motion
  auto const seed = static_cast<std::uint64_t>(experiment.seed);
  ExcitingMotion const found = search_excitation(chain, rows, options, seed, threads);
  auto const n = static_cast<Eigen::Index>(std::llround(options.period_s * options.rate_hz));
  auto const samples = samples_of(found.motion, FourierTable(n, options.harmonics));
  std::string const criterion =
      options.separate.empty() ? options.criterion : fmt::format("separate {}", fmt::join(options.separate, " from "));
  std::string const comment = fmt::format(
      "# {}: motion by torquescope excite; {}, {} harmonics of {:g} s, seed {}\n"
      "# condition {:.4g}, log determinant per parameter {:.4g}\n",
      chain.name, criterion, options.harmonics, options.period_s, seed, found.best.condition,
      found.best.log_determinant);
  std::string const text = arm_motion_text(samples, chain, comment);
  TempFile file(output);
  file.write_at(0, text.data(), text.size());
  file.publish();
  return {chain.name,
          arm.model.size(),
          found.usual.condition,
          found.best.condition,
          found.usual.log_determinant,
          found.best.log_determinant,
          found.usual.angle,
          found.best.angle,
          static_cast<std::size_t>(found.evaluations),
          static_cast<std::size_t>(n) + 1,
          options.period_s,
          options.rate_hz};
}

}  // namespace torquescope
