#include "engine/base/huge_pages.hpp"

#include <cstdint>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace torquescope {

void ask_for_huge_pages([[maybe_unused]] std::span<std::byte> unwritten) {
#ifdef MADV_HUGEPAGE
  constexpr std::size_t least_bytes = std::size_t{512} << 10, least_alone = std::size_t{4} << 20;
  constexpr std::uintptr_t page = 4096, huge_page = std::uintptr_t{2} << 20;
  if (unwritten.size() < least_bytes) return;
  auto const first = reinterpret_cast<std::uintptr_t>(unwritten.data()), last = first + unwritten.size();
  // a large array has pages of its own, a small one shares those of the heap
  bool const alone = unwritten.size() >= least_alone;
  auto const begin = alone ? (first + page - 1) / page * page : first / huge_page * huge_page;
  auto const end = alone ? last / page * page : (last + huge_page - 1) / huge_page * huge_page;
  // what lies behind the heap's end is refused, what lies before it served
  ::madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE);
#endif
}

}  // namespace torquescope
