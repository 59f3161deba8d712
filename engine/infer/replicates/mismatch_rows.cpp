#include "engine/infer/replicates/mismatch_rows.hpp"

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

#include "engine/fit/statistics/blocked_cv.hpp"
#include "engine/infer/replicates/twin_batch.hpp"

namespace torquescope {
namespace {

std::vector<Eigen::Index> common(std::vector<Eigen::Index> const& a, std::vector<Eigen::Index> const& b) {
  std::vector<Eigen::Index> both;
  std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(both));
  return both;
}

void check_rows(std::vector<Eigen::Index> const& rows, RecordPipeline const& pipeline, std::string const& name) {
  constexpr std::size_t fewest_per_parameter = 10;
  std::size_t const wanted =
      std::max(static_cast<std::size_t>(fewest_rows), fewest_per_parameter * pipeline.model().size());
  require_rows(rows.size(), wanted, name, fewer_reversals);
}

// one lane of a group, whose others are let go of; nothing when it runs away
std::optional<Recording> without_noise(CleanTwin const& twin, TwinAddress const& address, double rate_hz) {
  CleanTwin const quiet(twin.joint(), noiseless(twin.loop()), twin.track(), twin.step_s());
  TwinGroup alone;
  quiet.simulate(address, 0, alone);
  if (alone.ran_away.front()) return std::nullopt;
  return recording_of(alone, 0, rate_hz);
}

}  // namespace

MismatchRows in_torque_itself(MismatchRows rows) {
  if (rows.plain_residual.size() == 0) return rows;
  rows.residual = std::move(rows.plain_residual);
  rows.twins = std::move(rows.plain_twins);
  rows.twin_mean = rows.twins.rowwise().mean();
  return rows;
}

TwinComparison compare_with_twins(RecordedMotions const& recording, std::string const& name, CleanTwin const& twin,
                                  RecordPipeline& pipeline, TwinAddress const& address, std::size_t twins,
                                  TwinWorkers const& workers) {
  TwinComparison result;
  auto alone = without_noise(twin, address, pipeline.rate_hz());
  result.ran_away = !alone;
  if (result.ran_away) return result;
  // candidates are driven by it, whatever the model is: processed by itself, with its drive
  result.common = pipeline.process(*std::exchange(alone, std::nullopt));

  // pilots: rows at which a twin may turn are not safe in any
  std::size_t const n_pilots = std::min<std::size_t>(twins, twin_lanes);
  std::vector<ProcessedRecord> pilots(n_pilots);
  std::vector<char> ran_away(n_pilots, 0);
  for_each_twin(twin, pipeline, address, n_pilots, workers.threads, [&](VisitedTwin const& visited) {
    ran_away[visited.index] = visited.ran_away;
    auto const& record = visited.record;
    pilots[visited.index] = {{}, record.kept_rows, record.columns_themselves(), record.torque_itself(), {}, {}};
  });
  result.recording = pipeline.process(recording, name);
  std::vector<Eigen::Index> safe = common(result.recording.kept_rows, result.common.kept_rows);
  for (std::size_t i = 0; i < n_pilots; ++i)
    if (ran_away[i] == 0) safe = common(safe, pilots[i].kept_rows);
  check_rows(safe, pipeline, name);
  pipeline.restrict_to(safe);

  result.recording = pipeline.restricted(std::move(result.recording), safe, name);
  result.common = pipeline.restricted(std::move(result.common), safe, twins_name);
  auto& rows = result.rows;
  rows.rate_hz = pipeline.kept_rate_hz();
  rows.kept_rows = safe;
  static_cast<MotionAxes&>(rows) =
      motion_axes(pipeline.model(), result.common, result.common.parameters).picked([&](Eigen::VectorXd const& signal) {
        return pipeline.picked(signal, result.common);
      });
  rows.torque = result.recording.whole_torque();
  rows.residual = result.recording.residual;

  auto const n = static_cast<Eigen::Index>(safe.size());
  rows.twins.resize(n, static_cast<Eigen::Index>(twins));
  if (pipeline.whitens()) {
    rows.plain_residual = result.recording.residual_itself();
    rows.plain_twins.resize(n, static_cast<Eigen::Index>(twins));
  }
  result.twin_fits.resize(static_cast<Eigen::Index>(twins), static_cast<Eigen::Index>(pipeline.model().size()));
  auto const take = [&](std::size_t index, ProcessedRecord const& record) {
    rows.twins.col(static_cast<Eigen::Index>(index)) = record.residual;
    if (pipeline.whitens()) rows.plain_twins.col(static_cast<Eigen::Index>(index)) = record.residual_itself();
    result.twin_fits.row(static_cast<Eigen::Index>(index)) = record.parameters;
  };
  for (std::size_t i = 0; i < n_pilots; ++i)
    if (ran_away[i] == 0) take(i, pipeline.restricted(std::move(pilots[i]), safe, twins_name));
  bool const later_ran_away =
      gather_twins(twin, pipeline, address, {n_pilots, twins}, workers,
                   {column_each(rows.twins), column_each(rows.plain_twins), row_each(result.twin_fits)},
                   [&](VisitedTwin const& visited) { take(visited.index, visited.record); });
  result.ran_away = later_ran_away || std::any_of(ran_away.begin(), ran_away.end(), [](char one) { return one != 0; });
  if (!result.ran_away) rows.twin_mean = rows.twins.rowwise().mean();
  return result;
}

}  // namespace torquescope
