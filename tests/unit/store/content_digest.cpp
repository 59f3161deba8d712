#include "engine/store/content_digest.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <functional>
#include <memory>

#include "engine/store/result_reader.hpp"
#include "support/temporary_folder.hpp"
#include "unit/store/example_result.hpp"

namespace torquescope {
namespace content_digest_test {

TEST(ContentDigest, IsTheSameForTheSameContent) {
  test::TemporaryFolder const folder;
  std::string const first = example::write_result(folder / "a.h5");
  EXPECT_EQ(first.size(), 64U);
  // another order of runs, another storage, another machine
  EXPECT_EQ(example::write_result(folder / "b.h5", {}, {2, 0, 1}), first);
  EXPECT_EQ(example::write_result(folder / "c.h5", {.gzip = true}), first);
  EXPECT_EQ(example::write_result(folder / "d.h5", {}, {0, 1, 2}, "another host"), first);
  EXPECT_NE(test::bytes_of(folder / "a.h5"), test::bytes_of(folder / "d.h5"));
}

TEST(ContentDigest, OfTheWriterIsThatOfTheFile) {
  test::TemporaryFolder const folder;
  for (bool gzip : {false, true}) {
    std::string const written = example::write_large_result(folder / "R.h5", {.gzip = gzip});
    EXPECT_EQ(verify_result(folder / "R.h5"), written);
  }
}

TEST(ContentDigest, OfBlocksThatRepeatIsThatOfTheFile) {
  test::TemporaryFolder const folder;
  constexpr std::size_t per_block = digest_block_bytes / sizeof(double);
  // which value each block holds: several in a row alike, single ones between and at the end
  for (std::vector<int> const& values : {std::vector<int>{1, 1, 1, 1}, {1, 2, 2, 3}, {1, 1, 2}, {1, 2, 3}, {2, 1, 1}}) {
    std::vector<double> column;
    for (int const value : values) column.insert(column.end(), per_block, value);
    for (std::size_t rest : {std::size_t{0}, std::size_t{5}}) {
      column.insert(column.end(), rest, 7.0);
      ResultWriter writer(folder / "R.h5");
      example::write_job(writer);
      writer.numbers("/column", {column.size()}, column, {"1", "column"});
      std::string const written = writer.finish();
      EXPECT_EQ(verify_result(folder / "R.h5"), written) << column.size();
    }
  }
}

// runs whose memory nobody else holds any more, more of them than are digested side by side, beside others of other
// sizes
TEST(ContentDigest, OfRunsThatWaitIsThatOfTheFile) {
  test::TemporaryFolder const folder;
  constexpr std::size_t entries = 9000, n_runs = 37;  // above half a block of the digest: each run is one of its own
  std::string content;
  for (bool owned : {false, true}) {
    ResultWriter writer(folder / "R.h5");
    for (char const* name : {"/a", "/b"}) writer.declare_runs(name, n_runs, {entries}, {"1", "runs"});
    writer.declare_runs("/c", n_runs, {entries / 4}, {"1", "several in a block"});
    writer.declare_runs("/d", n_runs, {2 * entries}, {"1", "longer"});
    for (std::size_t run = 0; run < n_runs; ++run) {
      auto const values = [run](std::size_t count, double step) {
        std::vector<double> made(count);
        for (std::size_t i = 0; i < count; ++i) made[i] = static_cast<double>(run) + step * static_cast<double>(i);
        return std::make_shared<std::vector<double> const>(std::move(made));
      };
      auto const write = [&](char const* name, std::shared_ptr<std::vector<double> const> const& numbers) {
        writer.write_run(name, run, *numbers, owned ? numbers : nullptr);
      };
      write("/a", values(entries, 0.5));
      write("/b", values(entries, 0.25));
      write("/c", values(entries / 4, 2.0));
      write("/d", values(2 * entries, 1.0));
    }
    std::string const written = writer.finish();
    EXPECT_EQ(verify_result(folder / "R.h5"), written);
    if (content.empty()) content = written;
    EXPECT_EQ(written, content);
  }
}

// the digest of a small file that `change` had a hand in
std::string digest_with(std::function<void(ResultWriter&)> const& change) {
  test::TemporaryFolder const folder;
  ResultWriter writer(folder / "R.h5");
  example::write_job(writer);
  change(writer);
  return writer.finish();
}

TEST(ContentDigest, DiffersForOneChangedBit) {
  auto const with_number = [](double value) {
    return digest_with([&](ResultWriter& writer) { writer.numbers("/a", {1}, std::span(&value, 1), {"1", "a"}); });
  };
  double const one = 1.0;
  double const next = std::bit_cast<double>(std::bit_cast<std::uint64_t>(one) ^ 1U);
  EXPECT_EQ(with_number(one), with_number(one));
  EXPECT_NE(with_number(one), with_number(next));
  EXPECT_NE(with_number(0.0), with_number(-0.0));
}

TEST(ContentDigest, DiffersForAnythingAReaderCouldTellApart) {
  std::vector<double> const two{1, 2};
  std::vector<std::int64_t> const two_whole{1, 2};
  std::vector<std::string> const digests{
      digest_with([](ResultWriter&) {}),
      digest_with([&](ResultWriter& writer) {
        writer.numbers("/a", {2}, two, {"1", "a"});
      }),
      digest_with([&](ResultWriter& writer) {
        writer.numbers("/b", {2}, two, {"1", "a"});
      }),
      digest_with([&](ResultWriter& writer) {
        writer.numbers("/a", {1, 2}, two, {"1", "a"});
      }),
      digest_with([&](ResultWriter& writer) {
        writer.numbers("/a", {2, 1}, two, {"1", "a"});
      }),
      digest_with([&](ResultWriter& writer) {
        writer.numbers("/a", {2}, two, {"rad", "a"});
      }),
      digest_with([&](ResultWriter& writer) {
        writer.whole_numbers("/a", {2}, two_whole, {"1", "a"});
      }),
      digest_with([](ResultWriter& writer) {
        writer.texts("/a", std::vector<std::string>{"1", "2"}, {"1", "a"});
      }),
      digest_with([](ResultWriter& writer) {
        writer.texts("/a", std::vector<std::string>{"12", ""}, {"1", "a"});
      }),
      digest_with([](ResultWriter& writer) { writer.attribute("/a", "x", 1.0); }),
      digest_with([](ResultWriter& writer) { writer.attribute("/a", "x", std::int64_t{1}); }),
      digest_with([](ResultWriter& writer) { writer.attribute("/a", "x", std::string("1")); }),
      digest_with([](ResultWriter& writer) { writer.attribute("/a", "x", std::vector<double>{1.0}); }),
      digest_with([](ResultWriter& writer) { writer.attribute("/a", "x", std::vector<std::string>{"1"}); }),
      digest_with([](ResultWriter& writer) { writer.attribute("/a/x", "1", std::vector<std::string>{}); }),
  };
  for (std::size_t i = 0; i < digests.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) EXPECT_NE(digests[i], digests[j]) << i << " and " << j;
}

}  // namespace content_digest_test
}  // namespace torquescope
