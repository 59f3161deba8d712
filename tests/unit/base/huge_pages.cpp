// Asking for huge pages changes where memory lies, never what is in it.

#include "engine/base/huge_pages.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <vector>

namespace torquescope {
namespace huge_pages_test {

TEST(HugePages, LeaveNeighboursAndValuesAlone) {
  std::vector<double> memory(std::size_t{3} << 20);
  std::iota(memory.begin(), memory.end(), 0.0);
  // neither begins nor ends with a page
  ask_for_huge_pages(std::as_writable_bytes(std::span(memory).subspan(7, memory.size() - 20)));
  for (std::size_t i = 0; i < memory.size(); ++i) ASSERT_EQ(memory[i], static_cast<double>(i));
}

TEST(HugePages, OfLittleOrNothingAreNotAskedFor) {
  ask_for_huge_pages({});
  std::vector<double> few(10, 1.0);
  ask_for_huge_pages(std::as_writable_bytes(std::span(few)));
  EXPECT_EQ(few, std::vector<double>(10, 1.0));
}

}  // namespace huge_pages_test
}  // namespace torquescope
