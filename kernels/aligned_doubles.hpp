#pragma once
// A vector of doubles that begins on a cache line: an unaligned 64-byte load costs two. From 4 MB on it begins on a
// huge page and asks for more of them: kernels that stream from memory wait for page tables otherwise.
//
// Measured   residual_energy, AVX-512, n = 1e6, 30 members, on a shared Intel Xeon (guest of a virtual machine), % of
//            FMA peak for R = 4, 60 with 4 KB pages: 61 59, with huge pages: 85 75
// Errors     std::bad_alloc
// Threads    as std::vector

#include <cstddef>
#include <vector>

namespace torquescope::kernels {

inline constexpr std::size_t cache_line_bytes = 64;

// bytes must be the same in both
void* allocate_aligned(std::size_t bytes);
void free_aligned(void* data, std::size_t bytes);

template <class Number>
struct CacheLineAllocator {
  using value_type = Number;

  CacheLineAllocator() = default;
  template <class Other>
  CacheLineAllocator(CacheLineAllocator<Other> const&) {}

  Number* allocate(std::size_t count) { return static_cast<Number*>(allocate_aligned(count * sizeof(Number))); }
  void deallocate(Number* data, std::size_t count) { free_aligned(data, count * sizeof(Number)); }

  template <class Other>
  bool operator==(CacheLineAllocator<Other> const&) const {
    return true;
  }
};

using AlignedDoubles = std::vector<double, CacheLineAllocator<double>>;
using AlignedFloats = std::vector<float, CacheLineAllocator<float>>;

}  // namespace torquescope::kernels
