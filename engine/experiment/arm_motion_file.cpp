#include "engine/experiment/arm_motion_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/data/recording_reader.hpp"

namespace torquescope {

namespace {

// position, velocity, acceleration
std::array<std::string, 3> column_names(ChainJoint const& joint, std::size_t number) {
  char const* const unit = joint.kind == JointKind::revolute ? "rad" : "m";
  return {fmt::format("q{}_{}", number, unit), fmt::format("dq{}_{}_s", number, unit),
          fmt::format("ddq{}_{}_s2", number, unit)};
}

Eigen::VectorXd column(RawTable const& table, std::string const& name, Section const& section) {
  auto const found = std::find(table.names.begin(), table.names.end(), name);
  validate(found != table.names.end(), [&] {
    Problem problem = problem_at(section, "file", fmt::format("{} has no column {}", table.path, name),
                                 "a motion has t_s, q1_rad, dq1_rad_s, ddq1_rad_s2, q2_rad, ...: torquescope excite "
                                 "writes it");
    problem.notes.push_back(fmt::format("the file has: {}", fmt::join(table.names, ", ")));
    return problem;
  });
  auto const& values = table.columns[static_cast<std::size_t>(found - table.names.begin())];
  return Eigen::Map<Eigen::VectorXd const>(values.data(), static_cast<Eigen::Index>(values.size()));
}

double step_of(Eigen::VectorXd const& time_s, std::string const& file) {
  Eigen::Index const pieces = time_s.size() - 1;
  double const step = pieces > 0 ? (time_s[pieces] - time_s[0]) / static_cast<double>(pieces) : 0.0;
  bool equal = step > 0.0;
  for (Eigen::Index i = 0; i < pieces; ++i) equal = equal && std::abs(time_s[i + 1] - time_s[i] - step) <= 1e-3 * step;
  validate(equal, [&] {
    Problem problem;
    problem.code = ExitCode::bad_data;
    problem.what = file + " is no motion: t_s does not rise in equal steps";
    problem.help = "write at least two samples at one rate";
    return problem;
  });
  return step;
}

}  // namespace

std::vector<SampledMotion> read_arm_motion(std::filesystem::path const& file, SerialChain const& chain,
                                           Section const& section) {
  RawTable const table = read_table(file, section);
  double const step_s = step_of(column(table, "t_s", section), table.path);
  std::vector<SampledMotion> motions;
  for (std::size_t j = 0; j < chain.joints.size(); ++j) {
    auto const names = column_names(chain.joints[j], j + 1);
    motions.push_back(
        {step_s, column(table, names[0], section), column(table, names[1], section), column(table, names[2], section)});
  }
  return motions;
}

std::string arm_motion_text(MotionSamples const& samples, SerialChain const& chain, std::string const& comment) {
  constexpr int digits = 9;  // 1e-9 rad: below every encoder's step
  std::string text = comment + "t_s";
  for (std::size_t j = 0; j < chain.joints.size(); ++j)
    text += fmt::format(",{}", fmt::join(column_names(chain.joints[j], j + 1), ","));
  text += '\n';
  Eigen::Index const n = samples.q.rows();
  double const step_s = samples.time_s[1] - samples.time_s[0];
  for (Eigen::Index i = 0; i <= n; ++i) {
    text += fmt::format("{:.{}f}", step_s * static_cast<double>(i), digits);
    for (Eigen::Index j = 0; j < samples.q.cols(); ++j)
      for (auto const* of : {&samples.q, &samples.dq, &samples.ddq})
        text += fmt::format(",{:.{}f}", (*of)(i % n, j), digits);
    text += '\n';
  }
  return text;
}

}  // namespace torquescope
