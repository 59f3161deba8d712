// One flipped bit or a missing end is never read as if nothing had happened.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>

#include "engine/base/error.hpp"
#include "engine/store/result_reader.hpp"
#include "support/temporary_folder.hpp"
#include "unit/store/example_result.hpp"

// HDF5 1.10.8 itself loses some 400 bytes for each header that fails its checksum
extern "C" char const* __lsan_default_suppressions();
extern "C" char const* __lsan_default_suppressions() { return "leak:libhdf5"; }

namespace torquescope {
namespace damage_test {

// everything a program could take from the file, as one text; throws Error as the reader does
void collect(ResultReader const& reader, std::string const& path, std::string& all) {
  for (auto const& name : reader.attribute_names(path)) {
    all += path + "@" + name;
    auto const add = [&](auto const& value) { all += value ? to_text(OptionValue(*value)) : ""; };
    try {
      add(reader.find_attribute<std::vector<double>>(path, name));
    } catch (Error const&) {
      add(reader.find_attribute<std::vector<std::string>>(path, name));
    }
  }
  for (auto const& child : reader.children(path)) collect(reader, (path == "/" ? path : path + "/") + child, all);
}

std::string everything_in(std::filesystem::path const& name) {
  ResultReader const reader(name);
  std::string all;
  collect(reader, "/", all);
  for (auto const* path : {"/data/train/torque", "/runs/ols/parameters", "/runs/fade/population", "/runs/fade/mse"}) {
    auto const numbers = reader.numbers(path).values;
    all.append(reinterpret_cast<char const*>(numbers.data()), numbers.size() * sizeof(double));
  }
  auto const whole = reader.whole_numbers("/runs/fade/evaluations").values;
  all.append(reinterpret_cast<char const*>(whole.data()), whole.size() * sizeof(std::int64_t));
  for (auto const* path : {"/job/text", "/model/names"})
    for (auto const& text : reader.texts(path)) all += text;
  return all;
}

struct Counts {
  int detected = 0, harmless = 0, silent = 0;
};

Counts flip_bits(ResultWriterOptions options, int flips) {
  test::TemporaryFolder const folder;
  example::write_result(folder / "R.h5", options);
  std::string const whole = test::bytes_of(folder / "R.h5");
  std::string const truth = everything_in(folder / "R.h5");
  Counts counts;
  for (int i = 0; i < flips; ++i) {
    // spread over the whole file, another bit each time
    std::size_t const position = whole.size() * static_cast<std::size_t>(i) / static_cast<std::size_t>(flips);
    std::string damaged = whole;
    damaged[position] = static_cast<char>(damaged[position] ^ (1 << (i % 8)));
    test::write_bytes(folder / "D.h5", damaged);
    try {
      bool const same = everything_in(folder / "D.h5") == truth;
      ++(same ? counts.harmless : counts.silent);
      if (!same) ADD_FAILURE() << "silent flip at byte " << position << " of " << whole.size();
    } catch (Error const& error) {
      EXPECT_EQ(error.code(), ExitCode::bad_data);
      ++counts.detected;
    }
  }
  return counts;
}

TEST(DamagedResult, IsNeverReadAsIfItWereWhole) {
  for (bool gzip : {false, true}) {
    Counts const counts = flip_bits({.gzip = gzip}, 400);
    EXPECT_EQ(counts.silent, 0);
    // the rest fell on space that HDF5 allocated and nothing uses
    EXPECT_GT(counts.detected, 200);
    std::printf("gzip %d: %d flips detected, %d on unused bytes, %d silent\n", gzip, counts.detected, counts.harmless,
                counts.silent);
  }
}

TEST(DamagedResult, IsRefusedWhenItsEndIsMissing) {
  test::TemporaryFolder const folder;
  example::write_result(folder / "R.h5");
  std::string const whole = test::bytes_of(folder / "R.h5");
  for (std::size_t i = 0; i < 60; ++i) {
    test::write_bytes(folder / "D.h5", whole.substr(0, whole.size() * i / 60));
    try {
      verify_result(folder / "D.h5");
      ADD_FAILURE() << "read " << i << "/60 of a file";
    } catch (Error const& error) {
      EXPECT_EQ(error.code(), ExitCode::bad_data);
    }
  }
  test::write_bytes(folder / "D.h5", whole.substr(0, whole.size() - 1));
  EXPECT_THROW(verify_result(folder / "D.h5"), Error);
}

TEST(DamagedResult, NamesTheDatasetAndSparesTheOthers) {
  test::TemporaryFolder const folder;
  example::write_result(folder / "R.h5");
  std::string bytes = test::bytes_of(folder / "R.h5");
  double const first = example::population(0)[1];
  std::size_t const position = bytes.find(std::string(reinterpret_cast<char const*>(&first), sizeof(first)));
  ASSERT_NE(position, std::string::npos);
  bytes[position] = static_cast<char>(bytes[position] ^ 4);
  test::write_bytes(folder / "R.h5", bytes);

  ResultReader const reader(folder / "R.h5");
  EXPECT_EQ(reader.numbers("/data/train/torque").values, example::torque());
  auto const message = [](auto const& action) {
    try {
      action();
    } catch (Error const& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  std::string const expected = "is damaged in /runs/fade/population: data error detected by Fletcher32 checksum";
  EXPECT_THAT(message([&] { reader.numbers("/runs/fade/population"); }), testing::HasSubstr(expected));
  EXPECT_THAT(message([&] { reader.verify(); }), testing::HasSubstr(expected));
}

}  // namespace damage_test
}  // namespace torquescope
