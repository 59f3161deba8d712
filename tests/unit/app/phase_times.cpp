// The phases that a diagnosis prints add up to the time it took, whatever was told in between.

#include "engine/app/phase_times.hpp"

#include <gtest/gtest.h>

namespace torquescope {
namespace phase_times_test {

ProgressUpdate update(char const* stage, std::int64_t done, char const* counted = "replicates") {
  ProgressUpdate made;
  made.stage = stage;
  made.runs_done = done;
  made.counted = counted;
  return made;
}

TEST(PhaseTimes, AddUpToTheWallTime) {
  double now = 100.0;
  PhaseTimes times([&] { return now; });
  auto const at = [&](double time, ProgressUpdate const& told) {
    now = time;
    times.note(told);
  };
  at(101.0, update("twins", 0));
  at(105.0, update("twins", 200));
  at(105.5, update("search", 0, "effects"));
  at(108.0, update("search", 31, "effects"));
  at(118.0, update("twins", 0));  // ten seconds of refinement that nobody told of
  at(120.0, update("twins", 200));
  at(121.0, update("twins", 0));  // the same phase at once again
  at(122.0, update("twins", 100));
  at(123.0, update("verify", 0, "effects"));
  at(125.0, update("verify", 1, "effects"));
  now = 130.0;
  auto const phases = times.finish();
  ASSERT_EQ(phases.size(), 4u);
  double sum = 0.0;
  for (auto const& phase : phases) sum += phase.seconds;
  EXPECT_DOUBLE_EQ(sum, 30.0);
  EXPECT_EQ(phases[0].stage, "prepare");
  EXPECT_DOUBLE_EQ(phases[0].seconds, 1.0);
  EXPECT_EQ(phases[1].runs_done, 500);
  EXPECT_DOUBLE_EQ(phases[1].seconds, 4.5 + 5.0);
  EXPECT_DOUBLE_EQ(phases[2].seconds, 12.5);  // until the next phase began
  EXPECT_DOUBLE_EQ(phases[3].seconds, 7.0);   // until all was written
}

}  // namespace phase_times_test
}  // namespace torquescope
