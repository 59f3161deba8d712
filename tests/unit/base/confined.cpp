// Whatever work on a hostile file does, the process that asked for it lives on and can say what happened.

#include "engine/base/confined.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <cstdlib>
#include <new>
#include <optional>

#include "engine/base/packed_bytes.hpp"

namespace torquescope {
namespace confined_test {

Problem broke_off(std::string const& how) {
  Problem problem;
  problem.code = ExitCode::bad_data;
  problem.what = how;
  return problem;
}

std::optional<Problem> problem_of(std::function<std::string()> const& work, ConfinedLimits const& limits = {}) {
  try {
    run_confined(work, limits, broke_off);
  } catch (Error const& error) {
    return error.problems().front();
  }
  return std::nullopt;
}

TEST(ConfinedWork, GivesBackItsBytes) {
  std::string const large(std::size_t{5} << 20, '\0');
  EXPECT_EQ(run_confined([&] { return large + "end"; }, {}, broke_off), large + "end");
  EXPECT_EQ(run_confined([] { return std::string(); }, {}, broke_off), "");
}

TEST(ConfinedWork, ChangesNothingHere) {
  int changed = 0;
  run_confined([&] { return std::to_string(changed = 1); }, {}, broke_off);
  EXPECT_EQ(changed, 0);
}

TEST(ConfinedWork, ItsErrorsArriveWhole) {
  Problem sent{ExitCode::no_input, "what"};
  sent.place = {"file", 3, 4, 5, "line"};
  sent.key = "key";
  sent.notes = {"one", "two"};
  sent.caret_note = "caret";
  sent.help = "help";
  auto const problem = problem_of([&]() -> std::string { throw Error({sent, broke_off("second")}); });
  ASSERT_TRUE(problem);
  EXPECT_EQ(problem->code, ExitCode::no_input);
  EXPECT_EQ(problem->what, "what");
  EXPECT_EQ(problem->place.file + problem->place.line_text, "fileline");
  EXPECT_EQ(problem->place.line * 100 + problem->place.column * 10 + problem->place.length, 345);
  EXPECT_EQ(problem->key + problem->caret_note + problem->help, "keycarethelp");
  EXPECT_EQ(problem->notes, sent.notes);
}

TEST(ConfinedWork, MayCrash) {
  auto const problem = problem_of([]() -> std::string {
    ::signal(SIGSEGV, SIG_DFL);
    ::raise(SIGSEGV);
    return "";
  });
  ASSERT_TRUE(problem);
  EXPECT_EQ(problem->what, "crashed (signal 11)");
  EXPECT_EQ(problem->code, ExitCode::bad_data);
}

TEST(ConfinedWork, MayLoopForEver) {
  ConfinedLimits limits;
  limits.processor_seconds = 1;
  auto const problem = problem_of(
      []() -> std::string {
        volatile bool on = true;
        while (on) {
        }
        return "";
      },
      limits);
  ASSERT_TRUE(problem);
  EXPECT_EQ(problem->what, "took longer than 1 s");
}

TEST(ConfinedWork, MayRunOutOfMemoryOrLeave) {
  EXPECT_EQ(problem_of([]() -> std::string { throw std::bad_alloc(); })->what, "ran out of memory");
  EXPECT_EQ(problem_of([]() -> std::string { ::_exit(0); })->what, "ended early");
  EXPECT_EQ(problem_of([]() -> std::string { throw std::runtime_error("odd"); })->what, "failed: odd");
}

TEST(PackedBytes, ComeBackAndNeverReadBeyondTheirEnd) {
  PackedWriter out;
  out.text("name").numbers(std::vector<double>{1.5, -2.0}).texts({"", "x"}).whole(-7);
  std::string const bytes = std::move(out).take();
  PackedReader in(bytes);
  EXPECT_EQ(in.text(), "name");
  EXPECT_EQ(in.numbers<double>(), (std::vector<double>{1.5, -2.0}));
  EXPECT_EQ(in.texts(), (std::vector<std::string>{"", "x"}));
  EXPECT_EQ(in.whole(), -7);
  for (std::size_t size = 0; size < 36; ++size) {
    PackedReader cut(std::string_view(bytes).substr(0, size));
    EXPECT_THROW((cut.text(), cut.numbers<double>()), std::out_of_range) << size;
  }
}

}  // namespace confined_test
}  // namespace torquescope
