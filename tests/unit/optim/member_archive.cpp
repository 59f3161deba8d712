#include "engine/fit/optim/member_archive.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

namespace torquescope {
namespace member_archive_test {

RandomKey const key{7, 0, RandomDomain::test};

std::vector<double> firsts(MemberArchive const& archive) {
  std::vector<double> all;
  for (std::size_t i = 0; i < archive.size(); ++i) all.push_back(archive.row(i)[0]);
  return all;
}

TEST(MemberArchive, TakesWhatFitsAndThenReplaces) {
  MemberArchive archive(2);
  RandomStream random(key, 0, 0);
  for (double x = 0.0; x < 5.0; x += 1.0) archive.add(std::array{x, -x}, 3, random);
  ASSERT_EQ(archive.size(), 3u);
  auto const all = firsts(archive);
  EXPECT_TRUE(std::find(all.begin(), all.end(), 4.0) != all.end()) << "the newest is there";
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(archive.row(i)[1], -archive.row(i)[0]);
}

TEST(MemberArchive, WithoutRoomStaysEmpty) {
  MemberArchive archive(1);
  RandomStream random(key, 0, 0);
  archive.add(std::array{1.0}, 0, random);
  EXPECT_EQ(archive.size(), 0u);
}

TEST(MemberArchive, LosesAnyOfItsMembersWithTheSameProbability) {
  std::array<int, 4> lost{};
  for (std::uint32_t trial = 0; trial < 4000; ++trial) {
    MemberArchive archive(1);
    RandomStream random(key, 1, trial);
    for (double x = 0.0; x < 4.0; x += 1.0) archive.add(std::array{x}, 4, random);
    archive.shrink(3, random);
    auto all = firsts(archive);
    std::sort(all.begin(), all.end());
    ASSERT_EQ(std::unique(all.begin(), all.end()) - all.begin(), 3);
    for (std::size_t x = 0; x < 4; ++x)
      lost[x] += std::find(all.begin(), all.end(), static_cast<double>(x)) == all.end() ? 1 : 0;
  }
  // five standard deviations of a binomial count: 5 sqrt(4000 x 0.25 x 0.75) = 137
  for (int const count : lost) EXPECT_NEAR(count, 1000, 137);
}

}  // namespace member_archive_test
}  // namespace torquescope
