#pragma once
// Ranges of bytes of a file, disjoint and in order.
//
// Threads    one at a time

#include <cstdint>
#include <map>
#include <vector>

namespace torquescope {

struct ByteRange {
  std::uint64_t begin = 0, end = 0;
};

class ByteRanges {
 public:
  void add(std::uint64_t begin, std::uint64_t end);  // after close(): as remove()
  void remove(std::uint64_t begin, std::uint64_t end);
  void close() { closed_ = true; }
  // those that lie before `limit`, cut there
  std::vector<ByteRange> before(std::uint64_t limit) const;

 private:
  std::map<std::uint64_t, std::uint64_t> ends_;  // by where each begins; neighbours are one
  bool closed_ = false;
};

}  // namespace torquescope
