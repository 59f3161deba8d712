#pragma once
// Many replicates through the pipeline, one after the other on every thread: how a null distribution is made.
//
// visit      is called once per replicate, from any thread, in no order: write to the replicate's own place
// Sharing    gather_twins() visits only replicates computed here, others bring their numbers: what a visit writes must
//            stand in `places`, all of it
// Memory     one group of replicates per thread at the full rate, whatever the count
// Bits       what visit() gets depends on the address and the replicate alone
// Errors     whatever the pipeline or visit() throws; a replicate that diverged, or sticks where the recording moves,
//            is visited with ran_away = true and an empty record
// Threads    `threads` of base/parallel

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <limits>
#include <vector>

#include "engine/infer/pipeline/record_pipeline.hpp"
#include "engine/infer/replicates/twin_exchange.hpp"
#include "engine/simulate/clean_twin.hpp"

namespace torquescope {

struct VisitedTwin {
  std::size_t index = 0;
  int thread = 0;
  bool ran_away = false;
  ProcessedRecord const& record;
};

// of a row, in matrices of one row per kept sample and a column per twin: the twin does not keep it
inline constexpr double not_kept = std::numeric_limits<double>::infinity();

inline constexpr char const* twins_name = "replicates of this recording";  // in messages

// one of a group as if it had been recorded
Recording recording_of(TwinGroup const& group, std::size_t lane, double rate_hz);

void for_each_twin(CleanTwin const& twin, RecordPipeline const& pipeline, TwinAddress const& address,
                   TwinRange const& range, int threads, std::function<void(VisitedTwin const&)> const& visit);

// the first `count`
inline void for_each_twin(CleanTwin const& twin, RecordPipeline const& pipeline, TwinAddress const& address,
                          std::size_t count, int threads, std::function<void(VisitedTwin const&)> const& visit) {
  for_each_twin(twin, pipeline, address, TwinRange{0, count}, threads, visit);
}

// where every twin leaves its numbers: twin i's begin at first + i * next_twin, one every `next`
struct TwinPlaces {
  double* first;
  Eigen::Index count, next, next_twin;
};
inline TwinPlaces column_each(Eigen::MatrixXd& m) { return {m.data(), m.rows(), 1, m.rows()}; }
inline TwinPlaces row_each(Eigen::MatrixXd& m) { return {m.data(), m.cols(), m.rows(), 1}; }
inline TwinPlaces entry_each(Eigen::VectorXd& v) { return {v.data(), 1, 1, 1}; }

// the same work, shared with other processes where `workers` has any: fills the places of all twins. visit() is not
// called for a twin that ran away; returns whether any did
bool gather_twins(CleanTwin const& twin, RecordPipeline const& pipeline, TwinAddress const& address,
                  TwinRange const& range, TwinWorkers const& workers, std::vector<TwinPlaces> const& places,
                  std::function<void(VisitedTwin const&)> const& visit);

}  // namespace torquescope
