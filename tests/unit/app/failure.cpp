#include "engine/app/failure.hpp"

#include <gtest/gtest.h>

#include <new>
#include <stdexcept>
#include <system_error>

#include "engine/base/contract.hpp"

namespace torquescope {
namespace failure_test {

template <class Thrown>
Problem problem_of(Thrown thrown) {
  return problems_of(std::make_exception_ptr(thrown)).front();
}

TEST(Failure, OfAPromiseNamesThePlaceInTheSourceTreeOnly) {
  Problem const problem = problem_of(BrokenPromise("n > 0", "/home/somebody/engine/fit/problem/projection.cpp", 88));
  EXPECT_EQ(problem.code, ExitCode::internal);
  EXPECT_EQ(problem.what, "broken promise in engine/fit/problem/projection.cpp:88 (our fault): n > 0");
  EXPECT_EQ(problem.help, "report it with the job file and this line; results so far are safe");
}

TEST(Failure, OfTheUserKeepsItsCodeAndWords) {
  Problem bad;
  bad.code = ExitCode::bad_data;
  bad.what = "time runs backwards";
  EXPECT_EQ(problem_of(Error(bad)).code, ExitCode::bad_data);
  EXPECT_EQ(problem_of(Error(bad)).what, "time runs backwards");
}

TEST(Failure, OfAThreadThatDoesNotStartIsLackOfMemory) {
  std::system_error const limit(std::make_error_code(std::errc::resource_unavailable_try_again));
  EXPECT_EQ(problem_of(limit).what, problem_of(std::bad_alloc()).what);
  std::system_error const other(std::make_error_code(std::errc::no_such_device));
  EXPECT_NE(problem_of(other).what, problem_of(limit).what);
}

TEST(Failure, OfAnyOtherKindIsOurs) {
  EXPECT_EQ(problem_of(std::bad_alloc()).code, ExitCode::internal);
  EXPECT_EQ(problem_of(std::runtime_error("odd")).what, "unexpected: odd (our fault)");
  EXPECT_EQ(problem_of(7).code, ExitCode::internal);
}

}  // namespace failure_test
}  // namespace torquescope
