#pragma once
// Many twins through the pipeline, one after the other on every thread: what a statistic's null distribution is made from.
//
// visit      is called once per twin, from any thread, in no order: write to the twin's own place
// Memory     one group of twins per thread at the full rate, whatever the count
// Bits       what visit() gets depends on the address and the twin alone
// Errors     whatever the pipeline or visit() throws; a twin that ran away is visited with ran_away = true and an empty
//            record
// Threads    `threads` of base/parallel

#include <cstddef>
#include <functional>

#include "engine/diagnose/record_pipeline.hpp"
#include "engine/simulate/clean_twin.hpp"

namespace torquescope {

struct VisitedTwin {
  std::size_t index = 0;
  int thread = 0;
  bool ran_away = false;
  ProcessedRecord const& record;
};

// which twins of an address: [from, to), from a multiple of twin_lanes
struct TwinRange {
  std::size_t from = 0, to = 0;
};

void for_each_twin(CleanTwin const& twin, RecordPipeline const& pipeline, TwinAddress const& address,
                   TwinRange const& range, int threads, std::function<void(VisitedTwin const&)> const& visit);

// the first `count`
inline void for_each_twin(CleanTwin const& twin, RecordPipeline const& pipeline, TwinAddress const& address,
                          std::size_t count, int threads, std::function<void(VisitedTwin const&)> const& visit) {
  for_each_twin(twin, pipeline, address, TwinRange{0, count}, threads, visit);
}

}  // namespace torquescope
