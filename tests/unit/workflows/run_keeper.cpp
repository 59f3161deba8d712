// What the keeper promises: nothing for short jobs, one segment an interval, everything at a stop or of a shard; and
// that what it writes is read back to the bit, verified, by SavedRuns.

#include "engine/experiment/runs/run_keeper.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstring>
#include <set>
#include <thread>

#include "engine/base/error.hpp"
#include "engine/experiment/runs/saved_runs.hpp"
#include "support/temporary_folder.hpp"

namespace torquescope {
namespace run_keeper_test {

HistoryShape const shape{5, 9, 4, 2};  // runs, generations, members, parameters

// numbers that name their place
RunHistory history_of(std::size_t run, std::size_t generations) {
  RunHistory history;
  history.nonfinite = 3;
  for (std::size_t g = 0; g < generations; ++g) {
    double const base = 1000.0 * static_cast<double>(run) + static_cast<double>(g);
    for (std::size_t i = 0; i < 8; ++i) history.population.push_back(base + 0.01 * static_cast<double>(i));
    for (std::size_t i = 0; i < 4; ++i) history.fitness.push_back(base - 0.5);
    for (auto* list : {&history.F, &history.CR, &history.PC, &history.FC}) list->push_back(g ? base : std::nan(""));
    history.best.push_back(-base);
    history.gap.push_back(base * base);
    history.evaluations.push_back(static_cast<std::int64_t>(4 * g + 4));
  }
  return history;
}

std::shared_ptr<RunHistory const> ended(std::size_t run, std::size_t generations) {
  auto history = history_of(run, generations);
  history.told = generations;
  history.pad(10, 4, 2);
  history.parameters = {1.5, static_cast<double>(run)};
  history.stop_reason = "target";
  return std::make_shared<RunHistory const>(std::move(history));
}

std::unique_ptr<Optimiser> a_search() {
  std::vector<Problem> problems;
  auto search = find_optimiser("de")->prepare(Section{}, {}, problems)(Bounds{{0, 0}, {1, 1}}, RandomKey{5, 1});
  std::vector<double> candidates(search->batch_size() * 2), fitness(search->batch_size(), 1.0);
  // after one generation every number of its state is a number
  for (int batch = 0; batch < 2; ++batch) {
    search->ask({candidates.data(), search->batch_size(), 2});
    search->tell({candidates.data(), search->batch_size(), 2}, fitness);
  }
  return search;
}

void keep(RunKeeper& keeper, std::size_t run, std::size_t generations, Optimiser const& search) {
  RunHistory const history = history_of(run, generations);
  keeper.keep(run, {history, generations, [&] { return search.save(); }});
}

SegmentOrigin const origin{"job", "inputs", "program", "name", 0, 1, "", 1, 1, "now", ""};

class Keeping : public ::testing::Test {
 protected:
  RunKeeper keeper(double interval_s, bool everything = false) {
    return RunKeeper(
        {.folder = folder_ / "r.h5.parts", .origin = origin, .interval_s = interval_s, .everything = everything},
        hdf5_);
  }
  std::size_t segments() const { return segments_in(OpenFolder(folder_ / "r.h5.parts")).size(); }
  SavedRunsRequest request() const {
    return {.own_folder = folder_ / "r.h5.parts", .expected = origin, .searches = {{"de", "search"}}};
  }
  SavedRuns saved() const { return SavedRuns(request()); }
  static void wait(int milliseconds) { std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds)); }

  test::TemporaryFolder folder_;
  std::mutex hdf5_;
};

void expect_same_bits(RunHistory const& a, RunHistory const& b) {
  for (auto const& list : history_lists) {
    auto const &x = a.*list.values, &y = b.*list.values;
    ASSERT_EQ(x.size(), y.size()) << list.name;
    EXPECT_EQ(std::memcmp(x.data(), y.data(), x.size() * sizeof(double)), 0) << list.name;
  }
  EXPECT_EQ(a.evaluations, b.evaluations);
  EXPECT_EQ(a.parameters, b.parameters);
  EXPECT_EQ(a.stop_reason, b.stop_reason);
  EXPECT_EQ(a.nonfinite, b.nonfinite);
  EXPECT_EQ(a.told, b.told);
}

TEST_F(Keeping, AShortJobWritesNothing) {
  auto keeper = this->keeper(20.0);
  keeper.begin_estimator("de", "search", shape, {});
  for (std::size_t run = 0; run < 5; ++run) {
    keeper.begin(run);
    keeper.ended(run, ended(run, 10));
    EXPECT_EQ(keeper.due(), 0u);
  }
  keeper.write_all();
  EXPECT_FALSE(std::filesystem::exists(folder_ / "r.h5.parts")) << "not even the folder";
}

TEST_F(Keeping, WhatEndsAtOnceIsLetGoAndWhatComesLaterIsNot) {
  auto keeper = this->keeper(1.0);
  keeper.begin_estimator("de", "search", shape, {});
  keeper.ended(0, ended(0, 10));
  wait(130);  // more than a tenth of the interval
  keeper.ended(1, ended(1, 10));
  keeper.write_all();
  auto const runs = saved();
  EXPECT_FALSE(runs.has_ended("de", 0));
  EXPECT_TRUE(runs.has_ended("de", 1));
}

TEST_F(Keeping, AShardsRunsAreAllThere) {
  auto keeper = this->keeper(20.0, true);
  keeper.begin_estimator("de", "search", shape, {});
  for (std::size_t run = 0; run < 5; ++run) keeper.ended(run, ended(run, 4 + run));
  keeper.write_all();
  EXPECT_EQ(segments(), 1u);
  EXPECT_EQ(keeper.runs_safe(), 5u);
  auto runs = saved();
  for (std::size_t run = 0; run < 5; ++run) {
    EXPECT_TRUE(runs.has_ended("de", run));
    auto const part = runs.load("de", shape, run);
    ASSERT_TRUE(part && part->ended);
    expect_same_bits(part->history, *ended(run, 4 + run));
  }
  EXPECT_FALSE(runs.load("fade", shape, 0));
}

TEST_F(Keeping, ARunUnderWayIsWrittenPieceByPieceAndGoesOnFromItsLastState) {
  auto keeper = this->keeper(0.01);
  keeper.begin_estimator("de", "search", shape, {});
  auto const search = a_search();
  keeper.begin(3);
  for (std::size_t generations : {2u, 5u, 6u}) {
    auto const before = keeper.due();
    while (keeper.due() == before) wait(2);
    keep(keeper, 3, generations, *search);
  }
  EXPECT_EQ(segments(), 3u);
  auto runs = saved();
  EXPECT_FALSE(runs.has_ended("de", 3));
  EXPECT_EQ(runs.generations("de", 3), 6u);
  auto const part = runs.load("de", shape, 3);
  ASSERT_TRUE(part && !part->ended);
  expect_same_bits(part->history, history_of(3, 6));
  EXPECT_EQ(part->state, search->save());

  keeper.ended(3, ended(3, 6));  // with no generation more
  keeper.write_all();
  auto whole = saved();
  EXPECT_TRUE(whole.has_ended("de", 3));
  expect_same_bits(whole.load("de", shape, 3)->history, *ended(3, 6));
}

TEST_F(Keeping, ManySegmentsAreGatheredIntoFewWithoutLosingABit) {
  HistoryShape const longer{5, 600, 4, 2};
  auto keeper = this->keeper(0.0001);
  keeper.begin_estimator("de", "search", longer, {});
  auto const search = a_search();
  keeper.begin(0);
  keeper.begin(3);
  for (std::size_t generations = 1; generations <= 300; ++generations) {
    auto const before = keeper.due();
    while (keeper.due() == before) std::this_thread::sleep_for(std::chrono::microseconds(200));
    keep(keeper, 0, generations, *search);
    keep(keeper, 3, generations, *search);
  }
  EXPECT_EQ(keeper.segments_written(), 300u);
  EXPECT_LE(segments(), 1u + 2u + 15u) << "256 + 2 x 16 + 12";
  auto runs = saved();
  EXPECT_TRUE(runs.warnings().empty());
  for (std::size_t run : {0u, 3u}) {
    auto const part = runs.load("de", longer, run);
    ASSERT_TRUE(part && !part->ended);
    expect_same_bits(part->history, history_of(run, 300));
    EXPECT_EQ(part->state, search->save());
  }
}

// as another process does between this one's listing and its reading
TEST_F(Keeping, SegmentsThatAreGatheredMeanwhileAreFoundAgain) {
  auto keeper = this->keeper(20.0, true);
  keeper.begin_estimator("de", "search", shape, {});
  for (std::size_t run = 0; run < 2; ++run) {
    keeper.ended(run, ended(run, 4));
    keeper.write_all();
  }
  auto runs = saved();
  OpenFolder const parts(folder_ / "r.h5.parts");
  auto const before = segments_in(parts);
  ASSERT_EQ(before.size(), 2u);
  write_segment(folder_ / "r.h5.parts" / "shard-gathered.h5", origin, gathered_parts(before));
  for (auto const& place : before) std::filesystem::remove(place.path);
  for (std::size_t run = 0; run < 2; ++run) {
    auto const part = runs.load("de", shape, run);
    ASSERT_TRUE(part && part->ended);
    expect_same_bits(part->history, *ended(run, 4));
  }
  EXPECT_TRUE(runs.warnings().empty());
}

// neighbouring runs are in different segments, of more shards than a process may have files open
TEST_F(Keeping, RunsOfHundredsOfShardsAreRead) {
  auto const parts = folder_ / "r.h5.parts";
  make_segment_folder(parts);
  constexpr std::size_t shards = 210, runs = 2 * shards;
  HistoryShape const many{runs, shape.generations, shape.members, shape.parameters};
  auto const state_of = [](std::size_t run) {
    auto const number = static_cast<double>(run);
    return OptimiserState{{"few", {number}}, {"more", {number, 1.0, number}}, {"none", {}}};
  };
  for (std::size_t i = 0; i < shards; ++i) {
    EstimatorParts estimator{"de", "search", many, {}};
    for (std::size_t const run : {i + shards, i}) {
      RunPart part = part_of(*ended(run, 4), many, run, 0, 4);
      part.ended = true;
      part.history.stop_reason = "target";
      part.history.parameters = ended(run, 4)->parameters;
      part.state = state_of(run);
      estimator.parts.push_back(part);
    }
    SegmentOrigin of_shard = origin;
    of_shard.shard_index = i;
    of_shard.shard_count = shards;
    write_segment(parts / ("shard-" + std::to_string(i) + ".h5"), of_shard, {estimator});
  }
  auto found = saved();
  for (std::size_t run = 0; run < runs; ++run) {
    auto const part = found.load("de", many, run);
    ASSERT_TRUE(part && part->ended) << run;
    expect_same_bits(part->history, *ended(run, 4));
    EXPECT_EQ(part->history.last_state, state_of(run));
  }
}

// each process a segment per run, as those of before gathering left them
TEST_F(Keeping, WhatKilledProcessesLeftIsGatheredWriterByWriter) {
  auto const parts = folder_ / "r.h5.parts";
  make_segment_folder(parts);
  constexpr std::size_t many = 20, few = 3;
  std::vector<LeftSegment> left;
  for (std::size_t i = 0; i < many + few; ++i) {
    SegmentOrigin of_writer = origin;
    of_writer.pid = i < many ? 1 : 2;
    RunPart part = part_of(*ended(i % 2, 4), shape, i % 2, 0, 4);
    part.ended = true;
    part.history.stop_reason = ended(i % 2, 4)->stop_reason;
    part.history.parameters = ended(i % 2, 4)->parameters;
    left.push_back({parts / ("shard-" + std::to_string(100 + i) + ".h5"), of_writer});
    write_segment(left.back().file, of_writer, {{"de", "search", shape, {part}}});
  }
  EXPECT_TRUE(gather_left_segments(left, SegmentNames(parts, {}), 1U << 20));
  EXPECT_EQ(segments(), 1 + few);
  auto runs = saved();
  EXPECT_TRUE(runs.warnings().empty());
  std::set<std::int64_t> writers;
  for (auto const& one : runs.origins()) writers.insert(one.pid);
  EXPECT_EQ(writers, (std::set<std::int64_t>{1, 2}));
  for (std::size_t run : {0u, 1u}) {
    auto const part = runs.load("de", shape, run);
    ASSERT_TRUE(part && part->ended);
    expect_same_bits(part->history, *ended(run, 4));
  }
  EXPECT_FALSE(gather_left_segments({left.begin() + many, left.end()}, SegmentNames(parts, {}), 1U << 20));
}

TEST_F(Keeping, WaitsForEveryRunUnderWayBeforeItWrites) {
  auto keeper = this->keeper(0.01);
  keeper.begin_estimator("de", "search", shape, {});
  auto const search = a_search();
  keeper.begin(0);
  keeper.begin(1);
  while (keeper.due() == 0) wait(2);
  keep(keeper, 0, 3, *search);
  EXPECT_EQ(segments(), 0u);
  keep(keeper, 1, 2, *search);
  EXPECT_EQ(segments(), 1u);
}

TEST_F(Keeping, SegmentsOfAnotherJobProgramOrSearchAreRefused) {
  auto keeper = this->keeper(20.0, true);
  keeper.begin_estimator("de", "search", shape, {});
  keeper.ended(0, ended(0, 3));
  keeper.write_all();
  auto const code = [](SavedRunsRequest const& request) {
    try {
      SavedRuns const runs(request);
      return ExitCode::ok;
    } catch (Error const& error) {
      return error.code();
    }
  };
  EXPECT_EQ(code(request()), ExitCode::ok);
  for (auto const member : {&SegmentOrigin::inputs_sha256, &SegmentOrigin::numerics_sha256}) {
    auto other = request();
    other.expected.*member = "another";
    EXPECT_EQ(code(other), ExitCode::bad_job);
    other.allow_mixed = true;
    EXPECT_EQ(code(other), ExitCode::ok);
    EXPECT_TRUE(SavedRuns(other).mixed());
    other.searches["de"] = "another";
    EXPECT_EQ(code(other), ExitCode::bad_job) << "other numbers are never mixed in";
  }
}

TEST_F(Keeping, WhatLiesBehindAGapIsNotTaken) {
  auto keeper = this->keeper(20.0, true);
  keeper.begin_estimator("de", "search", shape, {{2, 4}});  // generations 0 to 3 are in a segment that is lost
  keeper.ended(2, ended(2, 8));
  keeper.write_all();
  auto runs = saved();
  EXPECT_FALSE(runs.has_ended("de", 2));
  EXPECT_EQ(runs.generations("de", 2), 0u);
  EXPECT_FALSE(runs.load("de", shape, 2));
}

TEST_F(Keeping, TwoAccountsOfOneRunMustAgree) {
  for (bool const agree : {true, false}) {
    for (int attempt = 0; attempt < 2; ++attempt) {
      auto keeper = this->keeper(20.0, true);
      keeper.begin_estimator("de", "search", shape, {});
      auto history = *ended(1, 7);
      if (!agree && attempt == 1) history.fitness[4 * 5] += 1e-9;
      keeper.ended(1, std::make_shared<RunHistory const>(history));
      keeper.write_all();
    }
    auto runs = saved();
    if (agree) {
      EXPECT_TRUE(runs.load("de", shape, 1));
      continue;
    }
    try {
      runs.load("de", shape, 1);
      FAIL();
    } catch (Error const& error) {
      EXPECT_EQ(error.code(), ExitCode::bad_data);
      EXPECT_NE(error.problems().front().what.find("generation 5 of run 1 of de"), std::string::npos);
      EXPECT_GE(error.problems().front().notes.size(), 2u) << "both are named";
    }
  }
}

}  // namespace run_keeper_test
}  // namespace torquescope
