// What segments say of themselves comes from another process as it stands in them, and nothing else does.

#include "engine/experiment/runs/segment_facts.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <string>

#include "engine/base/error.hpp"
#include "engine/experiment/runs/segment_look.hpp"
#include "support/temporary_folder.hpp"

namespace torquescope {
namespace segment_facts_test {

namespace fs = std::filesystem;

HistoryShape const shape{5, 3, 2, 1};  // runs, generations, members, parameters

RunHistory history_of(std::size_t generations, double value) {
  RunHistory history;
  for (auto const& list : history_lists) (history.*list.values).resize(list.width(shape) * generations, value);
  for (std::size_t g = 0; g < generations; ++g) {
    history.best[g] = value + static_cast<double>(g);
    history.evaluations.push_back(static_cast<std::int64_t>(g));
  }
  history.parameters = {value};
  history.stop_reason = "target";
  history.nonfinite = 3;
  history.elapsed_s = 0.5;
  return history;
}

std::vector<EstimatorParts> parts_of(std::size_t run) {
  RunPart ended{.run = run, .first = 0, .count = 4, .ended = true, .history = history_of(4, 1.5)};
  ended.state = {{"few", {1.0}}, {"more", {2.0, 3.0}}};
  RunPart begun{.run = run + 1, .first = 1, .count = 2, .history = history_of(2, 2.5)};
  return {{"de", "search", shape, {ended, begun}}};
}

SegmentOrigin origin_of(std::size_t shard) {
  return {"job", "inputs", "program", "name", shard, 3, "host", 7, 2, "began", "written"};
}

void expect_facts(SegmentFacts const& found, std::size_t shard) {
  EXPECT_EQ(found.origin.job_sha256, "job");
  EXPECT_EQ(found.origin.inputs_sha256, "inputs");
  EXPECT_EQ(found.origin.numerics_sha256, "program");
  EXPECT_EQ(found.origin.job_name, "name");
  EXPECT_EQ(found.origin.shard_index, shard);
  EXPECT_EQ(found.origin.shard_count, 3u);
  EXPECT_EQ(found.origin.host, "host");
  EXPECT_EQ(found.origin.pid, 7);
  EXPECT_EQ(found.origin.threads, 2);
  EXPECT_EQ(found.origin.started, "began");
  EXPECT_EQ(found.origin.written, "written");
  ASSERT_EQ(found.estimators.size(), 1u);
  auto const& index = found.estimators.at("de");
  EXPECT_EQ(index.search_sha256, "search");
  EXPECT_EQ(index.shape, shape);
  ASSERT_EQ(index.entries.size(), 2u);
  auto const& ended = index.entries[0];
  EXPECT_EQ(ended.run, shard);
  EXPECT_EQ(ended.first, 0u);
  EXPECT_EQ(ended.count, 4u);
  EXPECT_TRUE(ended.ended);
  EXPECT_EQ(ended.row, 0u);
  EXPECT_EQ(ended.state_end, 2u);
  EXPECT_EQ(ended.state_numbers, 3u);
  EXPECT_EQ(ended.stop_reason, "target");
  auto const& begun = index.entries[1];
  EXPECT_EQ(begun.run, shard + 1);
  EXPECT_EQ(begun.first, 1u);
  EXPECT_EQ(begun.count, 2u);
  EXPECT_FALSE(begun.ended);
  EXPECT_EQ(begun.row, 4u);
  EXPECT_EQ(begun.state_first, 2u);
  EXPECT_EQ(begun.state_number, 3u);
}

class SegmentsLookedAt : public testing::Test {
 protected:
  SegmentsLookedAt() {
    for (std::size_t shard = 0; shard < 3; ++shard) {
      places_.emplace_back(folder_ / ("shard-" + std::to_string(shard) + ".h5"));
      write_segment(places_.back(), origin_of(shard), parts_of(shard));
    }
  }

  test::TemporaryFolder folder_;
  std::vector<FilePlace> places_;
};

TEST_F(SegmentsLookedAt, SayWhatTheySaidWhenTheyWereWritten) {
  SegmentLook look(places_, [](SegmentFile&) {});
  for (std::size_t shard = 0; shard < 3; ++shard) {
    auto const found = look.facts(shard);
    EXPECT_EQ(found.name, places_[shard].path);
    EXPECT_EQ(found.bytes, fs::file_size(places_[shard].path));
    expect_facts(found, shard);
  }
}

TEST_F(SegmentsLookedAt, OneThatEndsTheProcessIsToldApartFromTheOthers) {
  auto const crash = [](SegmentFile& file) {
    if (file.facts().origin.shard_index == 1) std::abort();
  };
  SegmentLook look(places_, crash);
  expect_facts(look.facts(0), 0);
  EXPECT_THROW(look.facts(1), Error);
  expect_facts(look.facts(2), 2);
}

TEST_F(SegmentsLookedAt, OneThatIsDamagedSaysSo) {
  std::ofstream(places_[1].path, std::ios::trunc) << "no segment";
  SegmentLook look(places_, [](SegmentFile&) {});
  expect_facts(look.facts(0), 0);
  try {
    look.facts(1);
    ADD_FAILURE() << "it is no segment";
  } catch (Error const& error) {
    EXPECT_EQ(error.code(), ExitCode::bad_data);
    EXPECT_NE(error.problems().front().what.find("shard-1.h5"), std::string::npos) << error.problems().front().what;
  }
  expect_facts(look.facts(2), 2);
}

TEST_F(SegmentsLookedAt, ARunThatEndsWhereItWasKeptLastIsOneOfThem) {
  auto parts = parts_of(0);
  parts[0].parts.push_back({.run = 2, .first = 4, .count = 0, .ended = true, .history = history_of(0, 1.5)});
  write_segment(folder_ / "ended.h5", origin_of(0), parts);
  SegmentLook look({folder_ / "ended.h5"}, [](SegmentFile&) {});
  auto const found = look.facts(0);
  auto const& entries = found.estimators.at("de").entries;
  ASSERT_EQ(entries.size(), 3u);
  EXPECT_EQ(entries[2].first, 4u);
  EXPECT_EQ(entries[2].count, 0u);
  EXPECT_TRUE(entries[2].ended);
}

// a hostile file may have changed what the other process says
TEST_F(SegmentsLookedAt, BytesThatAreNoFactsAreRefused) {
  auto const facts = SegmentFile(places_[0]).facts();
  std::string const bytes = packed(facts);
  expect_facts(unpacked_facts(facts.name, bytes), 0);
  for (std::size_t end = 0; end < bytes.size(); end += 7)
    EXPECT_THROW(unpacked_facts(facts.name, std::string_view(bytes).substr(0, end)), std::out_of_range) << end;
  auto outside = facts;
  outside.estimators.at("de").entries[0].run = shape.runs;
  EXPECT_THROW(unpacked_facts(facts.name, packed(outside)), Error);
  outside = facts;
  outside.estimators.at("de").entries[1].count = shape.generations + 1;
  EXPECT_THROW(unpacked_facts(facts.name, packed(outside)), Error);
}

// the keeper hands on what ended without a copy
TEST_F(SegmentsLookedAt, AHistoryThatIsSharedIsWrittenLikeACopyOfIt) {
  auto const whole = std::make_shared<RunHistory const>(history_of(4, 1.5));
  for (std::size_t const first : {0u, 2u}) {
    RunPart copy = part_of(*whole, shape, 1, first, 4), shared{.run = 1, .first = first, .count = 4 - first};
    copy.ended = shared.ended = true;
    copy.history.stop_reason = whole->stop_reason;
    copy.history.parameters = whole->parameters;
    shared.whole = whole;
    std::string sha256[2];
    for (bool const is_shared : {false, true}) {
      auto const name = folder_ / ("one-" + std::to_string(first) + (is_shared ? "-shared.h5" : ".h5"));
      write_segment(name, origin_of(0), {{"de", "search", shape, {is_shared ? shared : copy}}});
      sha256[is_shared ? 1 : 0] = ResultReader(name).verify();
    }
    EXPECT_EQ(sha256[0], sha256[1]) << first;
  }
}

}  // namespace segment_facts_test
}  // namespace torquescope
