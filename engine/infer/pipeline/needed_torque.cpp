#include "engine/infer/pipeline/needed_torque.hpp"

#include <algorithm>

#include "engine/base/error.hpp"
#include "engine/infer/pipeline/joint_bounds.hpp"

namespace torquescope {
namespace {

// of the record's, those that no limited sample reaches through the filter
std::vector<Eigen::Index> rows_beside(ProcessedRecord const& record, RecordPipeline const& pipeline,
                                      std::vector<LimitedSample> const& limited) {
  Eigen::Index const n = record.motion->q.size();
  double const reach = static_cast<double>(guard_rows(pipeline)) * pipeline.rate_hz() / pipeline.kept_rate_hz();
  Eigen::VectorXd const at = pipeline.picked(Eigen::VectorXd::LinSpaced(n, 0.0, static_cast<double>(n - 1)), record);
  std::vector<Eigen::Index> rows;
  for (std::size_t i = 0; i < record.kept_rows.size(); ++i) {
    double const sample = at[static_cast<Eigen::Index>(i)];
    auto const next =
        std::lower_bound(limited.begin(), limited.end(), sample - reach,
                         [](auto const& one, double from) { return static_cast<double>(one.sample) < from; });
    if (next == limited.end() || static_cast<double>(next->sample) > sample + reach)
      rows.push_back(record.kept_rows[i]);
  }
  return rows;
}

Eigen::VectorXd parameters_beside(ProcessedRecord const& record, RecordPipeline const& pipeline,
                                  std::vector<LimitedSample> const& limited) {
  constexpr std::size_t fewest = 4;  // one row of so many
  std::vector<Eigen::Index> const rows = rows_beside(record, pipeline, limited);
  if (rows.size() == record.kept_rows.size() || rows.size() * fewest < record.kept_rows.size())
    return record.parameters;
  try {
    return pipeline.restricted(record, rows, "rows beside a limit").parameters;
  } catch (Error const&) {
    return record.parameters;
  }
}

}  // namespace

Eigen::VectorXd needed_torque(ProcessedRecord const& record, RecordPipeline const& pipeline,
                              std::vector<LimitedSample> const& limited) {
  JointModel const& model = pipeline.model();
  Eigen::VectorXd const parameters = without_negatives(parameters_beside(record, pipeline, limited), model);
  return model.motor_torque(record.motion, record.drive, parameters).given;
}

}  // namespace torquescope
