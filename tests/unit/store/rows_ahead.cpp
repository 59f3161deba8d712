// Rows are those of the dataset, whatever is asked for in which order, and few reads give many of them.

#include "engine/store/rows_ahead.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "engine/base/error.hpp"
#include "engine/store/result_writer.hpp"
#include "support/temporary_folder.hpp"

namespace torquescope {
namespace rows_ahead_test {

constexpr std::size_t n_rows = 100, width = 3;

class RowsAheadOf : public testing::Test {
 protected:
  RowsAheadOf() {
    std::iota(numbers_.begin(), numbers_.end(), 0.0);
    std::iota(whole_.begin(), whole_.end(), 7);
    for (std::size_t i = 0; i < n_rows; ++i) texts_.push_back("text " + std::to_string(i));
    ResultWriter writer(folder_ / "R.h5", {});
    writer.numbers("/numbers", {n_rows, width}, numbers_, {"1", "numbers"});
    writer.whole_numbers("/whole", {n_rows}, whole_, {"1", "whole numbers"});
    writer.texts("/texts", texts_, {"1", "texts"});
    writer.finish();
  }

  ResultReader const& open() {
    ++n_reads_;
    return *(reader_ = std::make_unique<ResultReader>(folder_ / "R.h5"));
  }

  h5::DatasetInfo layout(char const* path) const { return ResultReader(folder_ / "R.h5").layout(path); }

  template <class Value>
  void expect(RowsAhead<Value>& ahead, std::vector<Value> const& all, std::size_t first, std::size_t count) {
    auto const found = ahead.rows([&]() -> ResultReader const& { return open(); }, first, count);
    std::size_t const step = all.size() / n_rows;
    auto const expected = std::span(all).subspan(first * step, count * step);
    EXPECT_TRUE(std::equal(found.begin(), found.end(), expected.begin(), expected.end())) << first << " " << count;
  }

  test::TemporaryFolder folder_;
  std::unique_ptr<ResultReader> reader_;
  int n_reads_ = 0;
  std::vector<double> numbers_ = std::vector<double>(n_rows * width);
  std::vector<std::int64_t> whole_ = std::vector<std::int64_t>(n_rows);
  std::vector<std::string> texts_;
};

TEST_F(RowsAheadOf, OneReadServesManyRows) {
  RowsAhead<double> ahead("/numbers", layout("/numbers"), 10 * width * sizeof(double));
  for (std::size_t row = 0; row < n_rows; ++row) expect(ahead, numbers_, row, 1);
  EXPECT_EQ(n_reads_, 10);
}

// a chunk's checksum lies behind its values on the disk, and is read with them
TEST_F(RowsAheadOf, NothingIsChangedBehindThemButWhatIsSpare) {
  for (std::size_t const spare : {std::size_t{0}, h5::spare_for_checksum}) {
    for (std::size_t const first : {std::size_t{0}, n_rows - 1}) {
      std::size_t const count = (n_rows - first) * width;
      std::vector<double> room(count + 2, -1.0);
      open().read_rows("/numbers", first, n_rows - first, std::span(room).first(count), spare);
      auto const begin = numbers_.begin() + static_cast<std::ptrdiff_t>(first * width);
      EXPECT_TRUE(std::equal(begin, numbers_.end(), room.begin())) << spare << " " << first;
      EXPECT_TRUE(spare > 0 || room[count] == -1.0) << first;
      EXPECT_EQ(room[count + 1], -1.0) << spare << " " << first;
    }
  }
}

TEST_F(RowsAheadOf, WholeChunksAreReadWhereTheyFit) {
  h5::DatasetInfo chunked = layout("/numbers");
  chunked.chunk = {30, width};
  RowsAhead<double> ahead("/numbers", chunked, 20 * width * sizeof(double));
  expect(ahead, numbers_, 10, 1);
  for (std::size_t row = 10; row < n_rows; ++row) expect(ahead, numbers_, row, 1);
  EXPECT_EQ(n_reads_, 4) << "until 30, 60, 90 and the end";
}

TEST_F(RowsAheadOf, AnyOrderAndAnyCountGiveTheRowsOfTheFile) {
  for (std::size_t const bytes : {0u, 50u, 300u, 100000u}) {
    RowsAhead<double> numbers("/numbers", layout("/numbers"), bytes);
    RowsAhead<std::int64_t> whole("/whole", layout("/whole"), bytes);
    RowsAhead<std::string> texts("/texts", layout("/texts"), bytes);
    for (std::size_t step = 0; step < 200; ++step) {
      std::size_t const first = step * 37 % n_rows, count = step * 13 % (n_rows - first + 1);
      expect(numbers, numbers_, first, count);
      expect(whole, whole_, first, count);
      expect(texts, texts_, first, count);
    }
  }
}

TEST_F(RowsAheadOf, WhatSomebodyOwnsStaysWhateverIsAskedForLater) {
  RowsAhead<double> ahead("/numbers", layout("/numbers"), 10 * width * sizeof(double));
  auto const open_it = [&]() -> ResultReader const& { return open(); };
  auto const owned = ahead.rows(open_it, 3, 5);
  auto const owner = ahead.owner();
  for (std::size_t row = 5; row < n_rows; row += 7) expect(ahead, numbers_, row, 1);
  auto const expected = std::span(numbers_).subspan(3 * width, 5 * width);
  EXPECT_TRUE(std::equal(owned.begin(), owned.end(), expected.begin(), expected.end()));
}

TEST_F(RowsAheadOf, RowsBehindTheEndAreAnError) {
  RowsAhead<double> ahead("/numbers", layout("/numbers"), 1000);
  expect(ahead, numbers_, 90, 10);
  EXPECT_THROW(expect(ahead, numbers_, 95, 6), Error);
  EXPECT_THROW(expect(ahead, numbers_, 100, 1), Error);
  expect(ahead, numbers_, 99, 1);
}

}  // namespace rows_ahead_test
}  // namespace torquescope
