// `torquescope excite`: the motion from which a job's arm can best be identified, as a file.

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "engine/effects/model_options.hpp"
#include "engine/excite/excitation_search.hpp"
#include "engine/job/job_options.hpp"
#include "engine/run/arm_assembly.hpp"
#include "engine/run/arm_motion_file.hpp"
#include "engine/run/foreign_file.hpp"
#include "engine/run/job_sections.hpp"
#include "engine/run/workflows.hpp"
#include "engine/store/temp_file.hpp"

namespace torquescope {

namespace {

RowModel row_model(ArmModel const& model, ExciteOptions const& options) {
  RowModel rows;
  rows.size = static_cast<Eigen::Index>(model.size());
  for (std::size_t j = 0; j < model.joints(); ++j) rows.own.push_back(model.parameters_of(j));
  rows.noise = torque_noise(model.chain(), options);
  rows.rows = [&model](MotionSamples const& samples) {
    std::vector<Motion> motion(model.joints());
    for (std::size_t j = 0; j < motion.size(); ++j) {
      auto const at = static_cast<Eigen::Index>(j);
      motion[j].rate_hz = 1.0 / (samples.time_s[1] - samples.time_s[0]);
      motion[j].time_s = samples.time_s;
      motion[j].q = samples.q.col(at);
      motion[j].dq = samples.dq.col(at);
      motion[j].ddq = samples.ddq.col(at);
    }
    return model.rows(motion);
  };
  return rows;
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
  auto const model_options = read_options<ModelOptions>(job, problems);
  auto const options = read_options<ExciteOptions>(job, problems);
  require_robot(job, model_options, problems);
  if (!problems.empty()) throw Error(std::move(problems));
  ArmParts const arm = read_arm(job, model_options);
  SerialChain const& chain = arm.model.chain();
  check_excite(options, chain.joints.size(), section_or_empty(job, "excite"), problems);
  if (!problems.empty()) throw Error(std::move(problems));

  // the motion
  auto const seed = static_cast<std::uint64_t>(options.seed >= 0 ? options.seed : experiment.seed);
  ExcitingMotion const found = search_excitation(chain, row_model(arm.model, options), options, seed, threads);
  auto const n = static_cast<Eigen::Index>(std::llround(options.period_s * options.rate_hz));
  auto const samples = samples_of(found.motion, FourierTable(n, options.harmonics));
  std::string const comment = fmt::format(
      "# {}: motion by torquescope excite; {}, {} harmonics of {:g} s, seed {}\n"
      "# condition {:.4g}, log determinant per parameter {:.4g}\n",
      chain.name, options.criterion, options.harmonics, options.period_s, seed, found.best.condition,
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
          static_cast<std::size_t>(found.evaluations),
          static_cast<std::size_t>(n) + 1,
          options.period_s,
          options.rate_hz};
}

}  // namespace torquescope
