#include "engine/base/huge_pages.hpp"

#include <cstdint>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace torquescope {

void ask_for_huge_pages([[maybe_unused]] std::span<double> unwritten) {
#ifdef MADV_HUGEPAGE
  constexpr std::size_t least_bytes = std::size_t{4} << 20;
  constexpr std::uintptr_t page = 4096;
  if (unwritten.size_bytes() < least_bytes) return;
  // whole pages of the array alone
  auto const first = reinterpret_cast<std::uintptr_t>(unwritten.data());
  auto const begin = (first + page - 1) / page * page, end = (first + unwritten.size_bytes()) / page * page;
  ::madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE);
#endif
}

}  // namespace torquescope
