#include "engine/experiment/runs/run_part.hpp"

#include <algorithm>
#include <cstring>

#include "engine/base/contract.hpp"

namespace torquescope {
namespace {

template <class Value>
auto at(std::vector<Value> const& list, std::size_t index) {
  TORQUESCOPE_EXPECT(index <= list.size());
  return list.begin() + static_cast<std::ptrdiff_t>(index);
}

template <class Value>
void append_range(std::vector<Value>& to, std::vector<Value> const& from, std::size_t first, std::size_t end) {
  to.insert(to.end(), at(from, first), at(from, end));
}

// bits, not values: NaN is NaN here
template <class Value>
bool same_bits(std::vector<Value> const& a, std::size_t a_first, std::vector<Value> const& b, std::size_t b_first,
               std::size_t count) {
  return count == 0 || std::memcmp(a.data() + a_first, b.data() + b_first, count * sizeof(Value)) == 0;
}

}  // namespace

RunPart part_of(RunHistory const& history, HistoryShape const& shape, std::size_t run, std::size_t first,
                std::size_t end) {
  RunPart part{.run = run, .first = first, .count = end - first};
  for (auto const& list : history_lists) {
    std::size_t const width = list.width(shape);
    append_range(part.history.*list.values, history.*list.values, first * width, end * width);
  }
  append_range(part.history.evaluations, history.evaluations, first, end);
  part.history.nonfinite = history.nonfinite;
  part.history.elapsed_s = history.elapsed_s;
  return part;
}

void append(RunHistory& history, RunPart const& part, HistoryShape const& shape, std::size_t first) {
  std::size_t const begin = first - part.first;
  for (auto const& list : history_lists) {
    std::size_t const width = list.width(shape);
    append_range(history.*list.values, part.history.*list.values, begin * width, part.count * width);
  }
  append_range(history.evaluations, part.history.evaluations, begin, part.count);
  history.nonfinite = part.history.nonfinite;
  history.elapsed_s = part.history.elapsed_s;
}

std::size_t first_difference(RunHistory const& history, RunPart const& part, HistoryShape const& shape) {
  std::size_t const end = std::min(history.evaluations.size(), part.end());
  for (std::size_t generation = part.first; generation < end; ++generation) {
    std::size_t const place = generation - part.first;
    bool same = same_bits(history.evaluations, generation, part.history.evaluations, place, 1);
    for (auto const& list : history_lists) {
      std::size_t const width = list.width(shape);
      same =
          same && same_bits(history.*list.values, generation * width, part.history.*list.values, place * width, width);
    }
    if (!same) return generation;
  }
  return part.end();
}

}  // namespace torquescope
