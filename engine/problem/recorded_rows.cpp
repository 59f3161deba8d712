#include "engine/problem/recorded_rows.hpp"

#include <utility>

#include "engine/base/contract.hpp"
#include "engine/data/filter_checks.hpp"

namespace torquescope {
namespace {

Eigen::VectorXd as_numbers(std::vector<bool> const& flags) {
  Eigen::VectorXd numbers(static_cast<Eigen::Index>(flags.size()));
  for (std::size_t i = 0; i < flags.size(); ++i) numbers[static_cast<Eigen::Index>(i)] = flags[i] ? 1.0 : 0.0;
  return numbers;
}

// kept samples that some joint leaves out
std::vector<bool> left_out_instants(std::vector<Motion> const& motion, FilterOptions const& options,
                                    ParallelFilter const& filter) {
  std::vector<bool> out(static_cast<std::size_t>(filter.kept_samples()), false);
  for (auto const& joint : motion) {
    if (joint.left_out.empty()) continue;
    Eigen::VectorXd const picked = filter.pick(as_numbers(left_out_samples(joint, parallel_cutoff_of(options))));
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = out[i] || picked[static_cast<Eigen::Index>(i)] != 0.0;
  }
  return out;
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
  auto const out = left_out_instants(motion, options, filter);
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
    std::vector<Eigen::Index> moving, others;
    for (Eigen::Index i = 0; i < rows.instants; ++i)
      if (!out[static_cast<std::size_t>(i)]) (is_moving[i] != 0.0 ? moving : others).push_back(i);
    rows.moving.push_back(picked_rows(all, moving));
    rows.others.push_back(picked_rows(all, others));
  }
  return rows;
}

}  // namespace torquescope
