#include "engine/pipeline/motion_range.hpp"

namespace torquescope {
namespace {

bool is_within(double value, double least, double most) {
  constexpr double margin = 0.05;
  double const more = margin * (most - least);
  return value >= least - more && value <= most + more;
}

}  // namespace

MotionRange range_of(ProcessedRecord const& record, RecordPipeline const& pipeline) {
  Eigen::VectorXd const q = pipeline.picked(record.motion.q, record), dq = pipeline.picked(record.motion.dq, record);
  if (q.size() == 0) return {};
  return {q.minCoeff(), q.maxCoeff(), dq.minCoeff(), dq.maxCoeff()};
}

std::vector<Eigen::Index> rows_within(MotionRange const& range, ProcessedRecord const& record,
                                      RecordPipeline const& pipeline) {
  Eigen::VectorXd const q = pipeline.picked(record.motion.q, record), dq = pipeline.picked(record.motion.dq, record);
  std::vector<Eigen::Index> rows;
  for (Eigen::Index i = 0; i < q.size(); ++i)
    if (is_within(q[i], range.least_position, range.most_position) &&
        is_within(dq[i], range.least_velocity, range.most_velocity))
      rows.push_back(record.kept_rows[static_cast<std::size_t>(i)]);
  return rows;
}

}  // namespace torquescope
