#include "engine/store/byte_ranges.hpp"

#include <algorithm>
#include <iterator>

namespace torquescope {

void ByteRanges::add(std::uint64_t begin, std::uint64_t end) {
  if (closed_) return remove(begin, end);
  if (begin >= end) return;
  auto at = ends_.upper_bound(begin);
  if (at != ends_.begin() && std::prev(at)->second >= begin) --at;
  while (at != ends_.end() && at->first <= end) {
    begin = std::min(begin, at->first);
    end = std::max(end, at->second);
    at = ends_.erase(at);
  }
  ends_.emplace_hint(at, begin, end);
}

void ByteRanges::remove(std::uint64_t begin, std::uint64_t end) {
  if (begin >= end) return;
  auto at = ends_.upper_bound(begin);
  if (at != ends_.begin() && std::prev(at)->second > begin) --at;
  while (at != ends_.end() && at->first < end) {
    auto const [first, last] = *at;
    at = ends_.erase(at);
    if (first < begin) ends_.emplace(first, begin);
    if (last > end) ends_.emplace(end, last);
  }
}

std::vector<ByteRange> ByteRanges::before(std::uint64_t limit) const {
  std::vector<ByteRange> ranges;
  for (auto const& [begin, end] : ends_)
    if (begin < limit) ranges.push_back({begin, std::min(end, limit)});
  return ranges;
}

}  // namespace torquescope
