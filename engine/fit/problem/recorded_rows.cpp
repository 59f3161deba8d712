#include "engine/fit/problem/recorded_rows.hpp"

#include <algorithm>
#include <utility>

#include "engine/base/contract.hpp"
#include "engine/data/filter_checks.hpp"
#include "engine/fit/problem/joint_dependence.hpp"

namespace torquescope {
namespace {

Eigen::VectorXd as_numbers(std::vector<bool> const& flags) {
  Eigen::VectorXd numbers(static_cast<Eigen::Index>(flags.size()));
  for (std::size_t i = 0; i < flags.size(); ++i) numbers[static_cast<Eigen::Index>(i)] = flags[i] ? 1.0 : 0.0;
  return numbers;
}

// why each stretch is left out; of a motion that was simulated nobody has said it
std::vector<LeftOutStretch> reasons_of(Motion const& motion) {
  if (!motion.left_out_because.empty()) return motion.left_out_because;
  std::vector<LeftOutStretch> because;
  for (auto const& stretch : motion.left_out) because.push_back({stretch});
  return because;
}

// of a joint: its own stretches, and those in which nobody knows the motion of a joint that it feels
std::vector<std::vector<LeftOutStretch>> stretches_of_joints(std::vector<Motion> const& motion, ArmModel const& model) {
  std::vector<std::vector<LeftOutStretch>> of_joints;
  for (auto const& joint : motion) of_joints.push_back(reasons_of(joint));
  auto const own = of_joints;
  if (std::all_of(own.begin(), own.end(), [](auto const& one) { return one.empty(); })) return of_joints;
  auto const depends = motion_dependence(model);
  for (std::size_t j = 0; j < own.size(); ++j)
    for (std::size_t k = 0; k < own.size(); ++k)
      if (j != k && depends[j][k])
        for (auto const& stretch : own[k])
          if (stretch.of_motion) of_joints[j].push_back(stretch);
  return of_joints;
}

JointRows picked_rows(JointRows const& all, std::vector<Eigen::Index> const& rows) {
  JointRows picked;
  picked.columns = all.columns(rows, Eigen::all);
  for (auto signal : {&JointRows::torque, &JointRows::time_s, &JointRows::q, &JointRows::dq, &JointRows::ddq})
    picked.*signal = (all.*signal)(rows);
  picked.instant = rows;
  return picked;
}

}  // namespace

RecordedRows make_recorded_rows(std::string recording, std::vector<Motion> const& motion,
                                std::vector<std::vector<bool>> const& moves, FilterOptions const& options,
                                ArmModel const& model, Section const& section, std::optional<std::size_t> payload) {
  TORQUESCOPE_EXPECT(moves.size() == motion.size() && motion.size() == model.joints());
  auto const& first = motion.front();
  ParallelFilter const filter(options, first.rate_hz, first.q.size(), section);
  RecordedRows rows;
  rows.recording = std::move(recording);
  rows.rate_hz = first.rate_hz;
  rows.kept_rate_hz = filter.kept_rate_hz();
  rows.instants = filter.kept_samples();
  auto const left_out = stretches_of_joints(motion, model);
  auto columns = model.rows(motion, payload);
  for (std::size_t j = 0; j < motion.size(); ++j) {
    JointRows all;
    all.torque = filter.apply(payload ? (motion[j].torque - model.known_torque(j, columns[j], *payload)).eval()
                                      : motion[j].torque);
    all.columns = filter.apply_columns(columns[j]);
    columns[j].resize(0, 0);
    all.time_s = filter.pick(motion[j].time_s);
    all.q = filter.pick(motion[j].q);
    all.dq = filter.pick(motion[j].dq);
    all.ddq = filter.pick(motion[j].ddq);
    Eigen::VectorXd const is_moving = filter.pick(as_numbers(moves[j]));
    auto const stretch =
        stretch_of_samples(left_out[j], motion[j].q.size(), rows.rate_hz, filter, parallel_cutoff_of(options));
    std::vector<Eigen::Index> moving, others;
    std::vector<bool> turns;
    for (Eigen::Index i = 0; i < rows.instants; ++i) {
      turns.push_back(is_moving[i] == 0.0);
      if (stretch[static_cast<std::size_t>(i)] < 0) (turns.back() ? others : moving).push_back(i);
    }
    rows.accounts.push_back(row_account(left_out[j], stretch, turns, motion[j].q.size(), filter));
    rows.moving.push_back(picked_rows(all, moving));
    rows.others.push_back(picked_rows(all, others));
  }
  return rows;
}

}  // namespace torquescope
