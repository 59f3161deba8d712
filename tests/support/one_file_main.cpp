// The main of tests that are compiled together (scripts/cmake/layer.cmake, tests_together): the first argument names
// the file whose tests run, without its ending; without one, all of them run.
//
//   test_unit_store damage [--gtest_...]

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <string>
#include <string_view>

namespace {

std::string tests_of(std::string_view file) {
  std::string filter;
  auto const& all = *testing::UnitTest::GetInstance();
  for (int s = 0; s < all.total_test_suite_count(); ++s) {
    auto const& suite = *all.GetTestSuite(s);
    for (int t = 0; t < suite.total_test_count(); ++t) {
      auto const& test = *suite.GetTestInfo(t);
      if (std::filesystem::path(test.file()).stem() != file) continue;
      if (!filter.empty()) filter += ':';
      filter += std::string(suite.name()) + "." + test.name();
    }
  }
  return filter;
}

}  // namespace

int main(int argc, char** argv) {
  testing::InitGoogleMock(&argc, argv);
  if (argc < 2) return RUN_ALL_TESTS();
  std::string const filter = tests_of(argv[1]);
  if (filter.empty()) {
    std::fprintf(stderr, "%s: no test is in a file named %s.cpp\n", argv[0], argv[1]);
    return 64;
  }
  // a filter given beside the file says which of its tests
  if (testing::GTEST_FLAG(filter) == "*") testing::GTEST_FLAG(filter) = filter;
  return RUN_ALL_TESTS();
}
