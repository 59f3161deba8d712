#include "engine/base/heap.hpp"

#include <cstddef>
#include <cstdint>
#include <cstdlib>

#ifdef __GLIBC__
#include <malloc.h>
#include <sys/mman.h>
#endif

namespace torquescope {

void prepare_heap() {
#ifdef __GLIBC__
  constexpr std::size_t growth = std::size_t{12} << 20;
  ::mallopt(M_TRIM_THRESHOLD, 8 << 20);
  // out of the heap, to which it then belongs
  ::mallopt(M_MMAP_THRESHOLD, 2 * growth);
  void* const grown = std::malloc(growth);  // NOLINT(cppcoreguidelines-no-malloc): it is the heap that is set up
  ::mallopt(M_MMAP_THRESHOLD, 4 << 20);
  ::mallopt(M_TOP_PAD, growth);
#if defined(MADV_HUGEPAGE) && defined(MADV_POPULATE_WRITE)
  constexpr std::uintptr_t page = 4096, huge_page = std::uintptr_t{2} << 20;
  auto const first = reinterpret_cast<std::uintptr_t>(grown);
  auto const begin = (first + page - 1) / page * page, end = (first + growth) / page * page;
  auto const aligned = (first + huge_page - 1) / huge_page * huge_page;
  // what lies before the first page of 2 MB at once. An older kernel refuses one or the other: nothing is lost but time
  if (grown) {
    static_cast<void>(::madvise(reinterpret_cast<void*>(begin), aligned - begin, MADV_POPULATE_WRITE));
    static_cast<void>(::madvise(reinterpret_cast<void*>(aligned), end - aligned, MADV_HUGEPAGE));
  }
#endif
  std::free(grown);  // NOLINT(cppcoreguidelines-no-malloc): as above
#endif
}

void keep_heap() {
#ifdef __GLIBC__
  constexpr int whole = 1 << 30;
  ::mallopt(M_MMAP_THRESHOLD, whole / 2);
  ::mallopt(M_TRIM_THRESHOLD, whole);
#endif
}

void give_back_holes() {
#ifdef __GLIBC__
  constexpr std::size_t long_columns = std::size_t{16} << 20;
  if (::mallinfo2().hblkhd >= long_columns) ::malloc_trim(0);
#endif
}

}  // namespace torquescope
