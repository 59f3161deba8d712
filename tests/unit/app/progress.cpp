#include "engine/app/terminal/progress.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/app/terminal/plain_text.hpp"

namespace torquescope {
namespace progress_test {

using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;

ProgressUpdate update(std::int64_t runs, double seconds) { return {"fade", runs, 30, runs * 3000, 90000, seconds}; }

// a printer under a clock that the test sets
struct Watched {
  explicit Watched(ProgressStyle style, bool patient = false)
      : printer({style, [this](auto const& t) { text.push_back(t); }, [this] { return width; }, [this] { return now; },
                 false, patient}) {}
  std::vector<std::string> text;
  double now = 1000.0;
  int width = 80;
  ProgressPrinter printer;
};

TEST(ProgressStyle, NeedsATerminalForABar) {
  EXPECT_EQ(progress_style(ProgressChoice::automatic, {true, false, false, false}), ProgressStyle::bar);
  EXPECT_EQ(progress_style(ProgressChoice::automatic, {false, false, false, false}), ProgressStyle::lines);
  EXPECT_EQ(progress_style(ProgressChoice::automatic, {true, true, false, false}), ProgressStyle::lines);
  EXPECT_EQ(progress_style(ProgressChoice::automatic, {true, false, true, false}), ProgressStyle::lines);
  EXPECT_EQ(progress_style(ProgressChoice::bar, {false, false, false, false}), ProgressStyle::lines);
  EXPECT_EQ(progress_style(ProgressChoice::bar, {true, false, true, false}), ProgressStyle::bar);
}

TEST(ProgressStyle, IsNoneWhenQuiet) {
  for (auto choice : {ProgressChoice::automatic, ProgressChoice::bar, ProgressChoice::lines, ProgressChoice::none})
    EXPECT_EQ(progress_style(choice, {true, false, false, true}), ProgressStyle::none);
}

TEST(ProgressLine, IsWhatAProgramCanRead) {
  EXPECT_EQ(progress_line(update(20, 8.0)), "progress stage=fade runs=20/30 evals=60000/90000 eta_s=4\n");
  EXPECT_EQ(progress_line(update(2, 1.0)), "progress stage=fade runs=2/30 evals=6000/90000\n");
}

TEST(ProgressLines, ComeAtOnceThenOnePerTenPercent) {
  Watched watched(ProgressStyle::lines);
  for (int run = 0; run <= 30; ++run) watched.printer(update(run, 0.01 * run));
  EXPECT_EQ(watched.text.size(), 11u);
  EXPECT_THAT(watched.text.front(), HasSubstr("runs=0/30"));
  EXPECT_THAT(watched.text.back(), HasSubstr("runs=30/30"));
}

TEST(ProgressLines, ComeEveryMinuteWhenNothingElseHappens) {
  Watched watched(ProgressStyle::lines);
  for (int second = 0; second <= 180; ++second, watched.now += 1.0) watched.printer(update(1, second));
  EXPECT_EQ(watched.text.size(), 4u);
}

TEST(ProgressLines, BeginAgainWithEveryStage) {
  Watched watched(ProgressStyle::lines);
  watched.printer({"ols", 1, 1, 1, 1, 0.0});
  watched.printer({"de", 0, 30, 0, 90000, 0.0});
  EXPECT_THAT(watched.text, ElementsAre(HasSubstr("stage=ols"), HasSubstr("stage=de")));
}

TEST(ProgressLines, NobodyAskedForStayAwayFromShortStages) {
  Watched watched(ProgressStyle::lines, true);
  for (int run = 0; run <= 30; ++run, watched.now += 0.01) watched.printer(update(run, 0.01 * run));
  EXPECT_TRUE(watched.text.empty());
  // a long stage tells from its third second on
  for (int run = 0; run <= 30; ++run, watched.now += 0.2)
    watched.printer({"de", run, 30, run * 3000, 90000, 0.2 * run});
  EXPECT_THAT(watched.text.front(), HasSubstr("stage=de runs=10/30"));
  EXPECT_THAT(watched.text.back(), HasSubstr("stage=de runs=30/30"));
  EXPECT_EQ(watched.text.size(), 8u);
}

TEST(ProgressLines, ManyShortStagesGiveOneLineInTenSeconds) {
  Watched watched(ProgressStyle::lines, true);
  for (int stage = 0; stage < 30; ++stage) {
    std::string const name = "stage" + std::to_string(stage);
    watched.printer({name, 0, 1, 0, 0, 0.0});
    watched.now += 1.0;
    watched.printer({name, 1, 1, 0, 0, 1.0});
  }
  EXPECT_EQ(watched.text.size(), 3u);
}

TEST(ProgressBar, MovesWhileNothingIsCounted) {
  Watched watched(ProgressStyle::bar);
  watched.printer({"replicates", 0, 200, 0, 0, 0.0, "replicates"});
  watched.printer.beat();  // too early: what was told still stands
  EXPECT_EQ(watched.text.size(), 1u);
  for (int k = 0; k < 4; ++k) {
    watched.now += 0.5;
    watched.printer.beat();
  }
  ASSERT_EQ(watched.text.size(), 5u);
  for (std::size_t k = 2; k < 5; ++k) EXPECT_NE(watched.text[k], watched.text[k - 1]);
  EXPECT_THAT(watched.text.back(), HasSubstr("200 replicates   0:02"));
  // the next stage: the sum of both stands beside it
  watched.printer({"search", 0, 34, 0, 0, 0.0, "effects"});
  watched.now += 3.0;
  watched.printer.beat();
  EXPECT_THAT(watched.text.back(), HasSubstr("34 effects   0:03, 0:05 in all"));
}

TEST(ProgressBar, OfAWaitComesAfterASecond) {
  Watched watched(ProgressStyle::bar);
  watched.printer.wait_for("read");
  for (int k = 0; k < 9; ++k) {
    watched.now += 0.1;
    watched.printer.beat();
  }
  EXPECT_TRUE(watched.text.empty());
  watched.now += 0.2;
  watched.printer.beat();
  ASSERT_EQ(watched.text.size(), 1u);
  EXPECT_THAT(watched.text[0], HasSubstr("\rread"));
  EXPECT_THAT(watched.text[0], HasSubstr("0:01"));
}

TEST(ProgressLines, SayAWaitAfterASecond) {
  Watched watched(ProgressStyle::lines, true);
  watched.printer.wait_for("read");
  for (int k = 0; k < 9; ++k, watched.now += 0.1) watched.printer.beat();
  EXPECT_TRUE(watched.text.empty());
  for (int k = 0; k < 30; ++k, watched.now += 0.1) watched.printer.beat();
  EXPECT_THAT(watched.text, ElementsAre("progress stage=read seconds=1\n"));
}

TEST(ProgressBar, SaysTheTimeLeftOfAllStagesWhereItIsEstimated) {
  ProgressUpdate stage{"search", 0, 34, 0, 0, 0.0, "effects", 60.0};
  Watched watched(ProgressStyle::bar);
  watched.printer(stage);
  watched.now += 20.0;
  watched.printer.beat();
  EXPECT_THAT(watched.text.back(), HasSubstr("0:20, about 0:40 left"));
  watched.now += 45.0;  // longer than it was thought to take
  watched.printer.beat();
  EXPECT_THAT(watched.text.back(), Not(HasSubstr("left")));
  EXPECT_THAT(progress_line(stage, 20.0), HasSubstr("eta_s=40"));
}

TEST(WaitingBar, FitsEveryWindow) {
  for (int width = 20; width <= 80; ++width)
    for (double seconds : {0.0, 1.3, 77.0, 5000.0})
      EXPECT_LT(columns_of(waiting_bar({"replicates", 0, 200, 0, 0, seconds, "replicates"}, 9000.0, width, true)),
                width);
}

TEST(SecondsLeft, AreUnknownInTheFirstTwoSeconds) {
  EXPECT_EQ(seconds_left(update(10, 1.9)), std::nullopt);
  EXPECT_DOUBLE_EQ(seconds_left(update(10, 2.0)).value(), 4.0);
}

TEST(SecondsLeft, ComeFromEvaluationsBeforeTheFirstRunEnds) {
  EXPECT_DOUBLE_EQ(seconds_left({"fade", 0, 1, 250, 1000, 10.0}).value(), 30.0);
  EXPECT_EQ(seconds_left({"fade", 0, 1, 0, 1000, 10.0}), std::nullopt);
}

TEST(ProgressBar, SaysStageShareRateAndTimeLeft) {
  ProgressUpdate const now{"fade", 20, 30, 60000, 90000, 8.0};
  EXPECT_EQ(progress_bar(now, 80, false),
            "fade     ####################-----------  20/30 runs   7.5 k eval/s   0:04 left");
  EXPECT_THAT(progress_bar(now, 80, true), HasSubstr("████████████████████░░░░░░░░░░░"));
}

TEST(ProgressBar, FitsEveryWindow) {
  for (int width = 20; width <= 80; ++width) EXPECT_LT(columns_of(progress_bar(update(20, 8.0), width, true)), width);
}

TEST(ProgressBar, IsRedrawnTenTimesASecondAtMost) {
  Watched watched(ProgressStyle::bar);
  for (int i = 0; i < 1000; ++i, watched.now += 0.001) watched.printer(update(i / 100, 0.001 * i));
  EXPECT_LE(watched.text.size(), 11u);
  EXPECT_GE(watched.text.size(), 9u);
}

TEST(ProgressBar, IsErasedWithoutEscapeSequences) {
  Watched watched(ProgressStyle::bar);
  watched.printer(update(3, 1.0));
  watched.printer(update(30, 2.0));
  ASSERT_EQ(watched.text.size(), 2u);
  EXPECT_EQ(watched.text[1], "\r" + std::string(static_cast<std::size_t>(columns_of(watched.text[0])) - 1, ' ') + "\r");
  for (auto const& text : watched.text) EXPECT_THAT(text, Not(HasSubstr("\x1b")));
}

TEST(ProgressBar, SaysWhatItCounts) {
  ProgressUpdate now{"replicates", 120, 200, 0, 0, 1.0};
  now.counted = "replicates";
  EXPECT_NE(progress_bar(now, 80, true).find("120/200 replicates"), std::string::npos);
  EXPECT_EQ(progress_line(now),
            "progress stage=replicates runs=120/200\n");  // a stage without evaluations has no such key
}

TEST(ProgressBar, WipesWhatALongerOneLeftBehind) {
  Watched watched(ProgressStyle::bar);
  watched.printer({"a_rather_long_stage_name", 3, 30, 9000, 90000, 60.0});
  watched.now += 1.0;
  int const first = columns_of(watched.text.back());
  watched.printer({"a_rather_long_stage_name", 4, 30, 0, 0, 0.0});
  EXPECT_GE(columns_of(watched.text.back()), first);
}

TEST(ProgressBar, LeavesNothingWhenTheRunFails) {
  std::vector<std::string> text;
  {
    ProgressPrinter printer(
        {ProgressStyle::bar, [&](auto const& t) { text.push_back(t); }, [] { return 80; }, [] { return 1.0; }, false});
    printer(update(3, 1.0));
  }
  EXPECT_THAT(text.back(), EndsWith(" \r"));
}

}  // namespace progress_test
}  // namespace torquescope
