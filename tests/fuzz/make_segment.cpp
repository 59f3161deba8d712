// Writes a small segment, for seeds: two methods, one run that has ended and one that goes on.  make_segment FILE
#include <numeric>

#include "engine/experiment/runs/segment_file.hpp"

namespace torquescope {
namespace {

constexpr HistoryShape shape{.runs = 3, .generations = 4, .members = 5, .parameters = 2};

std::vector<double> rising(std::size_t count) {
  std::vector<double> values(count);
  std::iota(values.begin(), values.end(), 0.5);
  return values;
}

RunPart part(std::size_t run, std::size_t first, std::size_t count, bool ended) {
  RunPart made{.run = run, .first = first, .count = count, .ended = ended};
  for (auto const& list : history_lists) made.history.*list.values = rising(count * list.width(shape));
  for (std::size_t k = 0; k < count; ++k) made.history.evaluations.push_back(static_cast<std::int64_t>(5 * (k + 1)));
  made.history.stop_reason = ended ? "generations" : "";
  if (ended) made.history.parameters = rising(shape.parameters);
  if (!ended) made.state = {{"members", rising(10)}, {"memory_F", rising(3)}};
  return made;
}

}  // namespace
}  // namespace torquescope

int main(int, char** words) {
  using namespace torquescope;
  SegmentOrigin const origin{
      "job", "inputs", "numerics", "seed", 0, 2, "host", 1, 1, "2026-01-01T00:00:00Z", "2026-01-01T00:00:01Z"};
  write_segment(words[1], origin,
                {{"de", "search", shape, {part(0, 0, 5, true), part(2, 0, 3, false)}},
                 {"fade", "search", shape, {part(0, 2, 1, false)}}});
}
