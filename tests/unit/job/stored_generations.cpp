#include "engine/experiment/job/stored_generations.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace torquescope {
namespace stored_generations_test {

using Numbers = std::vector<std::size_t>;

Numbers numbers(std::string const& word, std::size_t generations) {
  auto const stored = StoredGenerations::of(word, generations).value();
  Numbers found;
  for (std::size_t entry = 0; entry < stored.count(); ++entry) found.push_back(stored.number(entry));
  return found;
}

// of a run that has generations [0, told): of what each entry is, and 99 where it is of nothing
Numbers in_run(std::string const& word, std::size_t generations, std::size_t told) {
  auto const stored = StoredGenerations::of(word, generations).value();
  Numbers found;
  for (std::size_t entry = 0; entry < stored.count(); ++entry) found.push_back(stored.in_run(entry, told).value_or(99));
  return found;
}

TEST(StoredGenerations, AreWhatTheWordSays) {
  EXPECT_EQ(numbers("full", 4), (Numbers{0, 1, 2, 3, 4}));
  EXPECT_EQ(numbers("every 1", 4), (Numbers{0, 1, 2, 3, 4}));
  EXPECT_EQ(numbers("every 2", 4), (Numbers{0, 2, 4}));
  EXPECT_EQ(numbers("every 3", 7), (Numbers{0, 3, 6, 7}));
  EXPECT_EQ(numbers("every 100", 7), (Numbers{0, 7}));
  EXPECT_EQ(numbers("every 18446744073709551615", 7), (Numbers{0, 7}));
  EXPECT_EQ(numbers("last", 7), (Numbers{7}));
}

TEST(StoredGenerations, AreAllWhereNoneIsLeftOut) {
  EXPECT_TRUE(StoredGenerations::of("full", 7)->all());
  EXPECT_TRUE(StoredGenerations::of("every 1", 7)->all());
  EXPECT_FALSE(StoredGenerations::of("every 2", 7)->all());
  EXPECT_FALSE(StoredGenerations::of("last", 7)->all());
}

TEST(StoredGenerations, KeepTheEndOfARunThatStoppedEarly) {
  EXPECT_EQ(in_run("full", 4, 3), (Numbers{0, 1, 2, 99, 99}));
  EXPECT_EQ(in_run("every 3", 10, 11), (Numbers{0, 3, 6, 9, 10}));
  EXPECT_EQ(in_run("every 3", 10, 6), (Numbers{0, 3, 5, 99, 99}));
  EXPECT_EQ(in_run("every 3", 10, 7), (Numbers{0, 3, 6, 99, 99}));
  EXPECT_EQ(in_run("every 3", 10, 1), (Numbers{0, 99, 99, 99, 99}));
  EXPECT_EQ(in_run("last", 10, 6), (Numbers{5}));
}

TEST(StoredGenerations, AreNoneInARunThatIsMissing) {
  EXPECT_EQ(in_run("every 5", 10, 0), (Numbers{99, 99, 99}));
  EXPECT_EQ(in_run("last", 10, 0), (Numbers{99}));
}

TEST(StoredGenerations, RefuseOtherWords) {
  for (std::string const word : {"", "Full", "none", "every", "every ", "every 0", "every -1", "every 2.5", "every 3x",
                                 "every  3", " last", "10", "every 18446744073709551616"})
    EXPECT_FALSE(StoredGenerations::of(word, 10)) << word;
}

}  // namespace stored_generations_test
}  // namespace torquescope
