#include "kernels/aligned_doubles.hpp"

#include <new>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace torquescope::kernels {
namespace {

constexpr std::size_t huge_page_bytes = 2 << 20;

bool is_large(std::size_t bytes) { return bytes >= 2 * huge_page_bytes; }

std::align_val_t alignment_of(std::size_t bytes) {
  return std::align_val_t{is_large(bytes) ? huge_page_bytes : cache_line_bytes};
}

}  // namespace

void* allocate_aligned(std::size_t bytes) {
  void* const data = ::operator new(bytes, alignment_of(bytes));
#ifdef MADV_HUGEPAGE
  // advice: where it is refused, pages are small and everything works
  if (is_large(bytes)) madvise(data, bytes, MADV_HUGEPAGE);
#endif
  return data;
}

void free_aligned(void* data, std::size_t bytes) { ::operator delete(data, alignment_of(bytes)); }

}  // namespace torquescope::kernels
