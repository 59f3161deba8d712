// What a writer keeps of its result is what a reader finds in the file, and what it does not keep is read from there.

#include "engine/store/written_result.hpp"

#include <gtest/gtest.h>

#include "engine/base/error.hpp"
#include "engine/store/result_writer.hpp"
#include "support/temporary_folder.hpp"

namespace torquescope {
namespace written_result_test {

std::vector<double> const short_numbers{1.5, -2.0, 3.25, 4.0, 5.0, 6.0};
std::vector<double> const long_numbers(100'000, 0.5);

WrittenResult write(std::filesystem::path const& name) {
  ResultWriter writer(name);
  writer.attribute("/job", "seed", std::int64_t{7});
  writer.attribute("/job", "title", std::string("first"));
  writer.attribute("/job", "title", std::string("second"));
  writer.attribute("/data/train", "recordings", std::vector<std::string>{"a", "bc"});
  writer.attribute("/data/train", "shares", std::vector<double>{0.5, 0.25});
  writer.numbers("/short", {2, 3}, short_numbers, {"1", "short"});
  writer.numbers("/long", {long_numbers.size()}, long_numbers, {"1", "long"});
  writer.texts("/words", std::vector<std::string>{"one", "", "three"}, {"1", "words"});
  writer.numbers_in_blocks("/blocks", {5},
                           [](std::size_t, std::span<double> values) { std::fill(values.begin(), values.end(), 2.0); },
                           {"1", "blocks"});
  writer.declare_runs("/runs/de/best", 2, {3}, {"1", "best"});
  writer.write_run("/runs/de/best", 0, std::vector<double>{1.0, 2.0, 3.0});
  writer.finish();
  return writer.take_written();
}

template <class Value>
void expect_same_attribute(WrittenResult const& written, ResultReader const& reader, std::string const& object,
                           std::string const& name) {
  EXPECT_EQ(written.attribute<Value>(object, name), reader.attribute<Value>(object, name)) << object << " " << name;
}

TEST(WrittenResult, SaysWhatAReaderSays) {
  test::TemporaryFolder const folder;
  WrittenResult const written = write(folder / "R.h5");
  ResultReader const reader(folder / "R.h5");
  for (char const* path : {"/", "/job", "/data", "/data/train", "/runs", "/runs/de", "/short", "/long", "/words",
                           "/blocks", "/runs/de/best", "/no", "/data/no"})
    EXPECT_EQ(written.exists(path), reader.exists(path)) << path;
  for (char const* path : {"/short", "/long", "/words", "/blocks", "/runs/de/best"})
    EXPECT_EQ(written.shape(path), reader.shape(path)) << path;
  for (char const* path : {"/short", "/long", "/blocks"}) {
    EXPECT_EQ(written.numbers(path).shape, reader.numbers(path).shape) << path;
    EXPECT_EQ(written.numbers(path).values, reader.numbers(path).values) << path;
  }
  EXPECT_EQ(written.texts("/words"), reader.texts("/words"));
  EXPECT_EQ(written.content_sha256(), reader.content_sha256());
  EXPECT_EQ(written.name(), reader.name());

  expect_same_attribute<std::int64_t>(written, reader, "/", complete_key);
  expect_same_attribute<std::int64_t>(written, reader, "/job", "seed");
  expect_same_attribute<double>(written, reader, "/job", "seed");  // a whole number is a number too
  expect_same_attribute<std::string>(written, reader, "/job", "title");
  expect_same_attribute<std::string>(written, reader, "/short", "long_name");
  expect_same_attribute<std::vector<std::string>>(written, reader, "/data/train", "recordings");
  expect_same_attribute<std::vector<double>>(written, reader, "/data/train", "shares");
  EXPECT_EQ(written.find_attribute<double>("/job", "no"), std::nullopt);
}

TEST(WrittenResult, KeepsWhatIsSmallAndReadsTheRest) {
  test::TemporaryFolder const folder;
  WrittenResult const written = write(folder / "R.h5");
  std::filesystem::remove(folder / "R.h5");
  EXPECT_EQ(written.numbers("/short").values, short_numbers);
  EXPECT_EQ(written.texts("/words").at(2), "three");
  EXPECT_THROW(written.numbers("/long"), Error);
  EXPECT_THROW(written.numbers("/blocks"), Error);
}

TEST(WrittenResult, RefusesWhatIsNotThere) {
  test::TemporaryFolder const folder;
  WrittenResult const written = write(folder / "R.h5");
  EXPECT_THROW(written.numbers("/no"), Error);
  EXPECT_THROW(written.shape("/no"), Error);
  EXPECT_THROW(written.attribute<double>("/job", "no"), Error);
  EXPECT_THROW(written.find_attribute<double>("/no", "no"), Error);
}

}  // namespace written_result_test
}  // namespace torquescope
