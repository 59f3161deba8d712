// The account of a recording's samples: every one counts once, with the first reason that leaves it out.

#include <gmock/gmock.h>

#include "engine/data/row_account.hpp"

namespace torquescope {
namespace row_account_test {

using testing::HasSubstr;

TEST(RowAccount, SumsToAllSamples) {
  for (double decimate_to_hz : {0.0, 20.0, 50.0}) {
    FilterOptions options;
    options.cutoff_hz = 20;
    options.parallel_cutoff_hz = 8;
    options.decimate_to_hz = decimate_to_hz;
    ParallelFilter const filter(options, 100.0, 3001, Section{"filter", {}, {}});
    std::vector<LeftOutStretch> const because{{{5, 7}, LeftOutReason::no_value, "q2"},
                                              {{6, 9}, LeftOutReason::asked_for},
                                              {{20, 21}, LeftOutReason::no_value, "q2"}};
    auto const stretch = stretch_of_samples(because, 3001, 100.0, filter, options.parallel_cutoff_hz);
    std::vector<bool> const turns(stretch.size(), true);
    for (auto const& no_turns : {std::vector<bool>{}, turns}) {
      auto const account = row_account(because, stretch, no_turns, 3001, filter);
      EXPECT_DOUBLE_EQ(account.read, 3001);
      EXPECT_DOUBLE_EQ(account.used() + account.left_out(), account.read);
      EXPECT_GE(account.used(), 0.0);
      EXPECT_EQ(account.used() == 0.0, !no_turns.empty());
      double of_q2 = 0, asked = 0;
      for (auto const& part : account.parts) {
        if (part.column == "q2") of_q2 += part.samples;
        if (part.why == RowAccount::Why::asked_for) asked += part.samples;
      }
      EXPECT_NEAR(of_q2, 300 + 4 * 12.5, 20);  // with the reach of the filter at each end
      EXPECT_NEAR(asked, 200, 20);             // what the first reason does not cover
      EXPECT_THAT(account_words(account), HasSubstr("without a value of \"q2\""));
    }
  }
}

}  // namespace row_account_test
}  // namespace torquescope
