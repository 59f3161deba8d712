#include "engine/experiment/runs/thinned_history.hpp"

#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace torquescope {
namespace {

// appends the stored ones of the generations [0, told) of one run, `width` values each; `absent` behind its end
template <class Value>
void append_stored(std::span<Value const> run, std::size_t width, std::size_t told, StoredGenerations const& stored,
                   Value absent, std::vector<Value>& to) {
  for (std::size_t entry = 0; entry < stored.count(); ++entry) {
    auto const generation = stored.in_run(entry, told);
    if (!generation) {
      to.insert(to.end(), width, absent);
      continue;
    }
    auto const values = run.subspan(*generation * width, width);
    to.insert(to.end(), values.begin(), values.end());
  }
}

template <class Value>
StoredRuns::List<Value> thinned_list(StoredRuns::List<Value> const& list, std::size_t runs, std::size_t width,
                                     std::size_t generations, StoredGenerations const& stored) {
  if (list.values.empty()) return {};
  std::vector<Value> kept;
  kept.reserve(runs * stored.count() * width);
  std::size_t const entries = generations + 1, size = entries * width;
  for (std::size_t run = 0; run < runs; ++run)
    append_stored<Value>(list.values.subspan(run * size, size), width, entries, stored, Value{}, kept);
  auto const owner = std::make_shared<std::vector<Value> const>(std::move(kept));
  return {*owner, owner};
}

}  // namespace

RunHistory thinned(RunHistory const& history, HistoryShape const& shape, StoredGenerations const& stored) {
  constexpr double absent = std::numeric_limits<double>::quiet_NaN();
  RunHistory kept;
  for (auto const& list : history_lists)
    append_stored<double>(history.*list.values, list.width(shape), history.told, stored, absent, kept.*list.values);
  // counts stay, as behind the end of a full history
  append_stored<std::int64_t>(history.evaluations, 1, history.told, stored, history.evaluations.back(),
                              kept.evaluations);
  return kept;
}

StoredRuns thinned(StoredRuns const& runs, HistoryShape const& shape, StoredGenerations const& stored) {
  StoredRuns kept{.count = runs.count};
  for (std::size_t i = 0; i < history_lists.size(); ++i)
    kept.histories[i] =
        thinned_list(runs.histories[i], runs.count, history_lists[i].width(shape), shape.generations, stored);
  kept.evaluations = thinned_list(runs.evaluations, runs.count, 1, shape.generations, stored);
  return kept;
}

}  // namespace torquescope
