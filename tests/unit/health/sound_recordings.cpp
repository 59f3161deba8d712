// A sound recording has no fault and no warning: 200 drawn ones of many rates, encoders, noises and motions.

#include <gtest/gtest.h>

#include "engine/data/health/finding_text.hpp"
#include "engine/data/health/make_recording.hpp"
#include "unit/health/sample_recording.hpp"

namespace torquescope {
namespace sound_recordings_test {

using health_test::Drawn;

TEST(SoundRecordings, HaveNoFaultAndNoWarning) {
  for (unsigned seed = 100; seed < 300; ++seed) {
    std::mt19937 engine(seed);
    auto const one_of = [&](std::vector<double> const& values) { return values[engine() % values.size()]; };
    Drawn drawn;
    drawn.rate_hz = one_of({50, 100, 189, 250, 500, 1000, 2000});
    drawn.seconds = one_of({6, 12, 25});
    drawn.amplitude = one_of({0.05, 0.3, 1.0, 2.5});
    drawn.encoder_step = one_of({0.0, 1e-5, 1e-4, 1.5e-3}) * drawn.amplitude;
    drawn.noise = one_of({0.0, 0.01, 0.1, 0.5});
    drawn.seed = seed;
    bool const with_velocity = seed % 3 == 0;
    auto table = health_test::sample_table(drawn);
    // half of them rest for a while, as pick and place does
    if (seed % 2 == 0)
      for (std::size_t row = table.columns[1].size() / 3; row < table.columns[1].size() / 2; ++row) {
        table.columns[1][row] = table.columns[1][table.columns[1].size() / 3 - 1];
        table.columns[3][row] = 0.0;
      }
    if (seed % 2 == 0) {  // and the motion goes on from where it rested
      std::size_t const from = table.columns[1].size() / 2;
      double const jump = table.columns[1][from] - table.columns[1][from - 1];
      for (std::size_t row = from; row < table.columns[1].size(); ++row) table.columns[1][row] -= jump;
    }
    auto const recording =
        make_recording(table, health_test::sample_options(with_velocity), Section{"recording", {}, {}});
    for (auto const& finding : recording.findings)
      EXPECT_EQ(finding.grade, Grade::note) << sentence_of(finding) << " (seed " << seed << ")";
    EXPECT_TRUE(recording.left_out.empty()) << seed;
  }
}

}  // namespace sound_recordings_test
}  // namespace torquescope
