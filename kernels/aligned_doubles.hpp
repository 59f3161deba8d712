#pragma once
// A vector of doubles that begins on a cache line: an unaligned 64-byte load costs two.
//
// Errors     std::bad_alloc
// Threads    as std::vector

#include <cstddef>
#include <new>
#include <vector>

namespace torquescope::kernels {

inline constexpr std::size_t cache_line_bytes = 64;

template <class Number>
struct CacheLineAllocator {
  using value_type = Number;

  CacheLineAllocator() = default;
  template <class Other>
  CacheLineAllocator(CacheLineAllocator<Other> const&) {}

  Number* allocate(std::size_t count) {
    return static_cast<Number*>(::operator new (count * sizeof(Number), std::align_val_t{cache_line_bytes}));
  }
  void deallocate(Number* data, std::size_t) { ::operator delete (data, std::align_val_t{cache_line_bytes}); }

  template <class Other>
  bool operator==(CacheLineAllocator<Other> const&) const {
    return true;
  }
};

using AlignedDoubles = std::vector<double, CacheLineAllocator<double>>;

}  // namespace torquescope::kernels
