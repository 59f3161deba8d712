#pragma once
// p-values of a few statistics on clean recordings: uniform when the twins are what they should be.

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <vector>

#include "engine/infer/replicates/disturbance_level.hpp"
#include "engine/infer/replicates/twin_batch.hpp"
#include "support/decompositions.hpp"
#include "unit/replicates/clean_records.hpp"

namespace torquescope::test {

inline constexpr std::array<char const*, 6> statistic_names{"energy",   "fast energy", "jerk (delay)",
                                                            "Stribeck", "position",    "largest residual"};
using Statistics = std::array<double, statistic_names.size()>;

// energy of the residual along what a column has beside the baseline
inline double gain(RecordPipeline const& pipeline, ProcessedRecord const& record, Eigen::VectorXd const& full_rate) {
  Eigen::VectorXd const column = left_beside(record.columns, pipeline.filtered(full_rate, record));
  double const along = column.dot(record.residual);
  return along * along / column.squaredNorm();
}

inline Statistics statistics(RecordPipeline const& pipeline, ProcessedRecord const& record) {
  Motion const& m = record.motion;
  Eigen::Index const n = m.q.size();
  Eigen::VectorXd jerk = Eigen::VectorXd::Zero(n);
  jerk.segment(1, n - 2) = (m.ddq.tail(n - 2) - m.ddq.head(n - 2)) * (m.rate_hz / 2.0);
  Eigen::VectorXd const stribeck = (-(m.dq.array() / 0.3).square()).exp() * m.dq.array().sign();
  Eigen::VectorXd const position = m.q.array().sin();
  return {record.energy(),
          fast_energy(record, pipeline),
          gain(pipeline, record, jerk),
          gain(pipeline, record, stribeck),
          gain(pipeline, record, position),
          record.residual.cwiseAbs().maxCoeff()};
}

struct Calibration {
  // [statistic][recording], (1 + twins at least as large) / (1 + twins)
  std::array<std::vector<double>, statistic_names.size()> p;
  std::vector<double> energy_ratio;  // recording over mean twin
  int not_white = 0;
};

// spoil: what happens to record number `index` before anybody sees it
using Spoil = std::function<void(Recording& recording, CleanJoint const& joint, std::uint32_t index)>;

inline Calibration calibrate(std::uint32_t records, std::size_t twins, double disturbance_share = 0.0, int threads = 2,
                             std::uint32_t first = 0, Spoil const& spoil = {}) {
  Calibration result;
  for (std::uint32_t index = first; index < first + records; ++index) {
    CleanJoint joint = clean_joint_number(index);
    joint.plan.noise.disturbance_std = disturbance_share * joint.truth[2];
    Recording recording = recorded(simulate_joint(joint.plan, 1000 + index));
    if (spoil) spoil(recording, joint, index);
    RecordPipeline const pipeline = clean_pipeline(recording);
    BaselineTwin const made =
        make_baseline_twin(recording, pipeline, clean_filter(), {1e-4, 2 * twin_lanes, index, 0}, threads);
    result.not_white += made.loop.source != LoopSource::identified;

    Statistics const of_recording = statistics(pipeline, made.record);
    std::vector<Statistics> of_twins(twins);
    for_each_twin(made.twin, pipeline, {index, 0, first_free_twin_set}, twins, threads,
                  [&](VisitedTwin const& visited) { of_twins[visited.index] = statistics(pipeline, visited.record); });
    double mean_energy = 0.0;
    for (auto const& one : of_twins) mean_energy += one[0] / static_cast<double>(twins);
    result.energy_ratio.push_back(of_recording[0] / mean_energy);
    for (std::size_t s = 0; s < statistic_names.size(); ++s) {
      auto const as_large = std::count_if(of_twins.begin(), of_twins.end(),
                                          [&](Statistics const& one) { return one[s] >= of_recording[s]; });
      result.p[s].push_back(static_cast<double>(1 + as_large) / static_cast<double>(1 + twins));
    }
  }
  return result;
}

// largest distance of the empirical distribution from the uniform one
inline double kolmogorov_smirnov(std::vector<double> p) {
  std::sort(p.begin(), p.end());
  double const n = static_cast<double>(p.size());
  double distance = 0.0;
  for (std::size_t i = 0; i < p.size(); ++i)
    distance = std::max(
        {distance, std::abs(p[i] - static_cast<double>(i) / n), std::abs(static_cast<double>(i + 1) / n - p[i])});
  return distance;
}

inline double share_below(std::vector<double> const& p, double level) {
  return static_cast<double>(std::count_if(p.begin(), p.end(), [&](double one) { return one <= level; })) /
         static_cast<double>(p.size());
}

}  // namespace torquescope::test
