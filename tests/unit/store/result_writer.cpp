#include "engine/store/result_writer.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <span>
#include <thread>

#include "engine/base/contract.hpp"
#include "engine/base/error.hpp"
#include "engine/base/version.hpp"
#include "engine/store/result_reader.hpp"
#include "support/temporary_folder.hpp"
#include "unit/store/example_result.hpp"

namespace torquescope {
namespace result_writer_test {

namespace fs = std::filesystem;

TEST(ResultWriter, RoundTripsEveryKindOfValue) {
  for (bool gzip : {false, true}) {
    test::TemporaryFolder const folder;
    std::string const sha256 = example::write_result(folder / "R.h5", {.gzip = gzip});
    ResultReader const reader(folder / "R.h5");

    EXPECT_EQ(reader.attribute<std::int64_t>("/", "format"), result_format);
    EXPECT_EQ(reader.attribute<std::string>("/", "creator"), std::string("torquescope ") + version);
    EXPECT_EQ(reader.content_sha256(), sha256);
    EXPECT_EQ(reader.verify(), sha256);

    EXPECT_EQ(reader.numbers("/data/train/torque").shape, (h5::Shape{example::samples}));
    EXPECT_EQ(reader.numbers("/data/train/torque").values, example::torque());
    EXPECT_EQ(reader.texts("/model/names"), (std::vector<std::string>{"inertia", "viscous"}));
    EXPECT_NE(reader.texts("/job/text").at(0).find("M\u00fcnchen\n"), std::string::npos);

    auto const population = reader.numbers("/runs/fade/population");
    EXPECT_EQ(population.shape, (h5::Shape{3, 5, 4, 2}));
    for (std::size_t run = 0; run < example::runs; ++run) {
      auto const first = population.values.begin() + static_cast<std::ptrdiff_t>(run * 5 * 4 * 2);
      EXPECT_EQ(std::vector<double>(first, first + 5 * 4 * 2), example::population(run));
    }
    EXPECT_EQ(reader.whole_numbers("/runs/fade/evaluations").shape, (h5::Shape{3, 5}));
    EXPECT_EQ(reader.whole_numbers("/runs/fade/evaluations").values[5], example::evaluations(1)[0]);
    EXPECT_EQ(reader.numbers("/runs/fade/mse").values, (std::vector<double>{0.09, 0.09 + 0.001, 0.09 + 0.002}));

    EXPECT_EQ(reader.attribute<std::string>("/runs/fade/population", "units"), "1");
    EXPECT_EQ(reader.attribute<std::string>("/runs/fade/population", "long_name"), "members");
    EXPECT_EQ(reader.attribute<std::string>("/runs/fade/population", "source"), "FADE, eq. 3");
    EXPECT_EQ(reader.find_attribute<std::string>("/runs/fade/mse", "source"), std::nullopt);
    EXPECT_EQ(reader.attribute<std::string>("/data/train", "NX_class"), "NXdata");
  }
}

TEST(ResultWriter, RoundTripsOddValues) {
  test::TemporaryFolder const folder;
  double const nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  std::vector<double> many(20000);
  for (std::size_t i = 0; i < many.size(); ++i) many[i] = static_cast<double>(i);
  std::vector<std::string> const words{"", "inertia", "Tr\u00e4gheit \u2192 \u03b8", std::string(5000, 'x')};
  {
    ResultWriter writer(folder / "R.h5");
    writer.numbers("/a/one", {}, std::vector<double>{-0.0}, {"rad", "one number alone"});
    writer.numbers("/a/none", {0, 4}, {}, {"rad", "no rows"});
    writer.numbers("/a/special", {4}, std::vector<double>{nan, infinity, -infinity, 5e-324}, {"rad", "special"});
    writer.numbers("/a/large", {200000, 3}, std::vector<double>(600000, 0.1), {"rad", "more than one chunk"});
    writer.whole_numbers("/a/whole", {1, 2}, std::vector<std::int64_t>{INT64_MIN, INT64_MAX}, {"1", "whole"});
    writer.texts("/a/words", words, {"1", "words"});
    writer.texts("/a/no_words", {}, {"1", "no words"});
    writer.attribute("/a", "yes", true);
    writer.attribute("/a", "many", many);
    writer.attribute("/a", "nothing", std::vector<double>{});
    writer.attribute("/a", "words", words);
    writer.attribute("/a", "no_words", std::vector<std::string>{});
    writer.attribute("/a", "columns", std::map<std::string, std::string>{{"time", "t_s"}, {"torque", "F_N"}});
    writer.attribute("/a", "again", std::int64_t{1});
    writer.attribute("/a", "again", std::string("replaced"));
    writer.finish();
  }
  ResultReader const reader(folder / "R.h5");
  EXPECT_EQ(reader.numbers("/a/one").shape, h5::Shape{});
  EXPECT_TRUE(std::signbit(reader.numbers("/a/one").values.at(0)));
  EXPECT_EQ(reader.numbers("/a/none").shape, (h5::Shape{0, 4}));
  auto const special = reader.numbers("/a/special").values;
  EXPECT_TRUE(std::isnan(special[0]));
  EXPECT_EQ(std::vector<double>(special.begin() + 1, special.end()),
            (std::vector<double>{infinity, -infinity, 5e-324}));
  EXPECT_EQ(reader.numbers("/a/large").values, std::vector<double>(600000, 0.1));
  EXPECT_EQ(reader.whole_numbers("/a/whole").values, (std::vector<std::int64_t>{INT64_MIN, INT64_MAX}));
  EXPECT_EQ(reader.texts("/a/words"), words);
  EXPECT_EQ(reader.texts("/a/no_words"), std::vector<std::string>{});
  EXPECT_EQ(reader.attribute<std::int64_t>("/a", "yes"), 1);
  EXPECT_EQ(reader.attribute<std::vector<double>>("/a", "many"), many);
  EXPECT_EQ(reader.attribute<std::vector<double>>("/a", "nothing"), std::vector<double>{});
  EXPECT_EQ(reader.attribute<std::vector<std::string>>("/a", "words"), words);
  EXPECT_EQ(reader.attribute<std::vector<std::string>>("/a", "no_words"), std::vector<std::string>{});
  EXPECT_EQ(reader.attribute<std::vector<std::string>>("/a", "columns"),
            (std::vector<std::string>{"time = t_s", "torque = F_N"}));
  EXPECT_EQ(reader.attribute<std::string>("/a", "again"), "replaced");
  EXPECT_NO_THROW(reader.verify());
}

TEST(ResultWriter, GivesTheSameBytesForTheSameCalls) {
  test::TemporaryFolder const folder;
  for (bool gzip : {false, true}) {
    example::write_result(folder / "a.h5", {.gzip = gzip});
    // HDF5 would store seconds if it stored times
    std::this_thread::sleep_for(std::chrono::milliseconds(1100));
    example::write_result(folder / "b.h5", {.gzip = gzip});
    EXPECT_TRUE(test::bytes_of(folder / "a.h5") == test::bytes_of(folder / "b.h5"));
  }
}

TEST(ResultWriter, CompressesHistoriesOfSurvivorsToLessThanThreeTenths) {
  // one member in five is replaced per generation; the others stay bit by bit, which is what gzip finds
  test::TemporaryFolder const folder;
  constexpr std::size_t entries = 101, members = 30, parameters = 4;
  std::vector<double> history;
  std::vector<double> population(members * parameters, 0.5);
  std::mt19937_64 numbers(7);
  for (std::size_t generation = 0; generation < entries; ++generation) {
    for (std::size_t member = 0; member < members; ++member)
      if (generation == 0 || numbers() % 5 == 0)
        for (std::size_t i = 0; i < parameters; ++i)
          population[member * parameters + i] = static_cast<double>(numbers()) * 0x1p-64;
    history.insert(history.end(), population.begin(), population.end());
  }
  auto const size = [&](bool gzip) {
    ResultWriter writer(folder / "R.h5", {.gzip = gzip});
    writer.declare_runs("/population", 5, {entries, members, parameters}, {"1", "members"});
    for (std::size_t run = 0; run < 5; ++run) writer.write_run("/population", run, history);
    writer.finish();
    verify_result(folder / "R.h5");
    return static_cast<double>(fs::file_size(folder / "R.h5"));
  };
  EXPECT_LE(size(true), 0.3 * size(false));
}

// widths whose blocks have 4096, 8 and 1 runs
TEST(ResultWriter, WritesNeighboursTogetherAsOneAfterTheOther) {
  test::TemporaryFolder const folder;
  constexpr std::size_t n_runs = 50;
  std::vector<std::size_t> const widths{2, 1000, 9000};
  std::vector<std::string> const paths{"/a", "/b", "/c"};
  std::vector<std::vector<double>> values;
  for (std::size_t const width : widths) {
    values.emplace_back(n_runs * width);
    std::iota(values.back().begin(), values.back().end(), 0.0);
  }
  auto const written = [&](std::size_t together) {
    auto const name = folder / ("R" + std::to_string(together) + ".h5");
    ResultWriter writer(name);
    for (std::size_t i = 0; i < paths.size(); ++i) writer.declare_runs(paths[i], n_runs, {widths[i]}, {"1", "a list"});
    for (std::size_t run = 0; run < n_runs; run += together) {
      std::size_t const count = std::min(together, n_runs - run);
      std::vector<ResultWriter::RunsOfList> lists;
      for (std::size_t i = 0; i < paths.size(); ++i) {
        auto const part = std::span<double const>(values[i]).subspan(run * widths[i], count * widths[i]);
        if (together == 1) writer.write_run(paths[i], run, part);
        lists.push_back({paths[i], h5::Element::number, std::as_bytes(part), {}});
      }
      if (together > 1) writer.write_runs(run, count, lists);
    }
    writer.finish();
    return test::bytes_of(name);
  };
  auto const one_by_one = written(1);
  for (std::size_t const together : {3U, 8U, 17U, 50U}) EXPECT_EQ(written(together), one_by_one) << together;
}

TEST(ResultWriter, ReadsAbsentRunsAsNanAndZero) {
  test::TemporaryFolder const folder;
  example::write_result(folder / "R.h5", {}, {2});
  ResultReader const reader(folder / "R.h5");
  auto const population = reader.numbers("/runs/fade/population").values;
  EXPECT_TRUE(std::isnan(population.front()));
  EXPECT_EQ(population.back(), example::population(2).back());
  EXPECT_EQ(reader.whole_numbers("/runs/fade/evaluations").values[0], 0);
}

TEST(ResultWriter, ReadsBackRunsLargerThanTheChunkCache) {
  // 12 runs of 2.4 MB in parts, and 3000 small ones that share chunks, both written out of order
  test::TemporaryFolder const folder;
  constexpr std::size_t large = 101 * 100 * 30, n_small = 3000, small = 101;
  auto const value = [](std::size_t run, std::size_t i) {
    return static_cast<double>(run) + 1e-6 * static_cast<double>(i);
  };
  {
    ResultWriter writer(folder / "R.h5");
    writer.declare_runs("/large", 12, {101, 100, 30}, {"1", "large"});
    writer.declare_runs("/small", n_small, {small}, {"1", "small"});
    for (std::size_t i = 0; i < 12; ++i) {
      std::size_t const run = i * 5 % 12;
      std::vector<double> values(large);
      for (std::size_t j = 0; j < large; ++j) values[j] = value(run, j);
      writer.write_run("/large", run, values);
    }
    for (std::size_t i = 0; i < n_small; ++i) {
      std::size_t const run = i * 1009 % n_small;
      std::vector<double> values(small);
      for (std::size_t j = 0; j < small; ++j) values[j] = value(run, j);
      writer.write_run("/small", run, values);
    }
    writer.finish();
  }
  ResultReader const reader(folder / "R.h5");
  auto const expect_all = [&](std::string const& path, std::size_t per_run) {
    auto const values = reader.numbers(path).values;
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < values.size(); ++i) wrong += values[i] != value(i / per_run, i % per_run);
    EXPECT_EQ(wrong, 0U) << path;
  };
  expect_all("/large", large);
  expect_all("/small", small);
}

TEST(ResultWriter, LeavesTheFinalNameAloneUntilItIsFinished) {
  test::TemporaryFolder const folder;
  test::write_bytes(folder / "R.h5", "an older result");
  {
    ResultWriter writer(folder / "R.h5");
    example::write_job(writer);
    EXPECT_EQ(test::bytes_of(folder / "R.h5"), "an older result");
    EXPECT_EQ(folder.n_files(), 2U);
  }
  // given up: nothing but the older result remains
  EXPECT_EQ(test::bytes_of(folder / "R.h5"), "an older result");
  EXPECT_EQ(folder.n_files(), 1U);

  example::write_result(folder / "R.h5");
  EXPECT_EQ(folder.n_files(), 1U);
  EXPECT_NO_THROW(verify_result(folder / "R.h5"));
}

TEST(ResultWriter, StepsAsideForTheLeftoverOfAKilledProcess) {
  test::TemporaryFolder const folder;
  std::string const leftover = "R.h5.tmp." + std::to_string(::getpid());
  test::write_bytes(folder / leftover, "left over");
  example::write_result(folder / "R.h5");
  EXPECT_EQ(test::bytes_of(folder / leftover), "left over");
  EXPECT_EQ(folder.n_files(), 2U);
}

TEST(ResultWriter, NeverWritesThroughALink) {
  test::TemporaryFolder const folder;
  test::write_bytes(folder / "victim", "precious");
  fs::create_symlink(folder / "victim", folder / ("R.h5.tmp." + std::to_string(::getpid())));
  fs::create_symlink(folder / "victim", folder / "R.h5");
  example::write_result(folder / "R.h5");
  EXPECT_EQ(test::bytes_of(folder / "victim"), "precious");
  EXPECT_FALSE(fs::is_symlink(folder / "R.h5"));
}

TEST(ResultWriter, WritesInBlocksWhatItWritesWhole) {
  // 2.1 and 0.7 MiB: blocks of whole chunks, the last one shorter
  constexpr std::size_t rows = 90'001, width = 3;
  std::vector<double> values(rows * width);
  std::vector<std::int64_t> places(rows);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = std::sqrt(static_cast<double>(i));
  for (std::size_t i = 0; i < rows; ++i) places[i] = static_cast<std::int64_t>(i * i);

  test::TemporaryFolder const folder;
  ResultWriter whole(folder / "whole.h5"), blocks(folder / "blocks.h5");
  whole.numbers("/a/values", {rows, width}, values, {"1", "values"});
  whole.whole_numbers("/a/places", {rows}, places, {"1", "places"});
  std::size_t largest = 0, next = 0;
  blocks.numbers_in_blocks("/a/values", {rows, width},
                           [&](std::size_t first, std::span<double> block) {
                             EXPECT_EQ(first, next);
                             next += block.size() / width;
                             largest = std::max(largest, block.size_bytes());
                             std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(first * width), block.size(),
                                         block.begin());
                           },
                           {"1", "values"});
  blocks.whole_numbers_in_blocks("/a/places", {rows},
                                 [&](std::size_t first, std::span<std::int64_t> block) {
                                   std::copy_n(places.begin() + static_cast<std::ptrdiff_t>(first), block.size(),
                                               block.begin());
                                 },
                                 {"1", "places"});
  EXPECT_EQ(next, rows);
  EXPECT_LE(largest, std::size_t{1} << 20);
  EXPECT_EQ(blocks.finish(), whole.finish());
  EXPECT_EQ(ResultReader(folder / "blocks.h5").numbers("/a/values").values, values);
}

TEST(ResultWriter, CutsRowsThatAreWiderThanAChunk) {
  test::TemporaryFolder const folder;
  constexpr std::size_t rows = 3, width = 200'000;
  std::vector<double> values(rows * width);
  std::iota(values.begin(), values.end(), 0.0);
  for (bool const gzip : {false, true}) {
    ResultWriter writer(folder / "wide.h5", {.gzip = gzip});
    writer.numbers_in_blocks("/a/values", {rows, width},
                             [&](std::size_t first, std::span<double> block) {
                               std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(first * width), block.size(),
                                           block.begin());
                             },
                             {"1", "values"});
    writer.finish();
    EXPECT_EQ(ResultReader(folder / "wide.h5").numbers("/a/values").values, values) << gzip;
  }
}

TEST(ResultWriter, LetsTheUmaskDecideWhoMayRead) {
  test::TemporaryFolder const folder;
  mode_t const before = ::umask(027);
  example::write_result(folder / "R.h5");
  ::umask(before);
  EXPECT_EQ(fs::status(folder / "R.h5").permissions(), fs::perms(0640));
}

TEST(ResultWriter, SaysWhereItCannotWrite) {
  test::TemporaryFolder const folder;
  auto const code_and_text = [](fs::path const& name) {
    try {
      ResultWriter const writer(name);
    } catch (Error const& error) {
      return std::pair(error.code(), std::string(error.what()));
    }
    return std::pair(ExitCode::ok, std::string());
  };
  auto const [missing_code, missing_text] = code_and_text(folder / "no/such/R.h5");
  EXPECT_EQ(missing_code, ExitCode::io);
  EXPECT_EQ(missing_text, "cannot write " + (folder / "no/such/R.h5").string() + ": no such file or directory");
  EXPECT_EQ(code_and_text(folder.path()).first, ExitCode::exists);
}

#if defined(TORQUESCOPE_CONTRACTS)
TEST(ResultWriter, HoldsCallersToTheirPromises) {
  test::TemporaryFolder const folder;
  ResultWriter writer(folder / "R.h5");
  EXPECT_THROW(writer.numbers("/a", {3}, std::vector<double>(2), {"1", "two of three"}), BrokenPromise);
  EXPECT_THROW(writer.numbers("/a", {2}, std::vector<double>(2), {"", "no unit"}), BrokenPromise);
  writer.declare_runs("/b", 2, {4}, {"1", "runs"});
  EXPECT_THROW(writer.write_run("/b", 0, std::vector<double>(3)), BrokenPromise);
  EXPECT_THROW(writer.write_run("/b", 2, std::vector<double>(4)), BrokenPromise);
  EXPECT_THROW(writer.write_run("/b", 0, std::vector<std::int64_t>(4)), BrokenPromise);
  writer.write_run("/b", 0, std::vector<double>(4));
  EXPECT_THROW(writer.write_run("/b", 0, std::vector<double>(4)), BrokenPromise);
  EXPECT_NO_THROW(writer.finish());
}
#endif

}  // namespace result_writer_test
}  // namespace torquescope
