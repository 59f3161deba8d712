// Every bit outside the values is compared before HDF5 sees it, and whose file it is stands where no library is needed.

#include "engine/store/file_seal.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "engine/base/error.hpp"
#include "engine/store/result_reader.hpp"
#include "engine/store/verification.hpp"
#include "support/temporary_folder.hpp"
#include "unit/store/example_result.hpp"

namespace torquescope {
namespace file_seal_test {

namespace fs = std::filesystem;

std::optional<Sha256> identity_of(fs::path const& name) {
  int const descriptor = ::open(name.c_str(), O_RDONLY);
  auto const found = sealed_identity(descriptor);
  ::close(descriptor);
  return found;
}

class FileSeal : public testing::Test {
 protected:
  FileSeal() {
    example::write_result(folder_ / "R.h5", {.inputs_sha256 = "job"});
    whole_ = test::bytes_of(folder_ / "R.h5");
  }

  test::TemporaryFolder folder_;
  std::string whole_;
};

TEST_F(FileSeal, SaysWhoseItIs) {
  EXPECT_EQ(check_seal(ReadFile(folder_ / "R.h5")), Seal::whole);
  EXPECT_EQ(identity_of(folder_ / "R.h5"), job_identity("job", Keeps::result));
  EXPECT_EQ(identity_of(folder_.write("text.h5", "my own words")), std::nullopt);
  EXPECT_EQ(identity_of(folder_.write("cut.h5", whole_.substr(0, whole_.size() - 1))), std::nullopt);
  EXPECT_EQ(identity_of(folder_.write("headless.h5", "x" + whole_)), std::nullopt);
}

// the values alone have checksums of their own: HDF5 meets them when it reads them
TEST_F(FileSeal, IsBrokenByAnyBitThatHdf5WouldBuildOn) {
  fs::path const name = folder_ / "flipped.h5";
  std::size_t broken = 0, by_checksum = 0;
  for (std::size_t place = 0; place < whole_.size(); place += 7) {
    std::string flipped = whole_;
    flipped[place] = static_cast<char>(flipped[place] ^ (1 << (place % 8)));
    test::write_bytes(name, flipped);
    if (check_seal(ReadFile(name)) == Seal::broken) {
      ++broken;
      EXPECT_THROW(ResultReader reader(name), Error) << place;
      continue;
    }
    ++by_checksum;
    EXPECT_THROW(verify_everything(name), Error) << "silent: byte " << place;
  }
  EXPECT_GT(broken, 100u);
  EXPECT_GT(by_checksum, 100u);
}

TEST_F(FileSeal, IsAbsentWhereAnotherProgramWroteAndThenNobodyVerifies) {
  std::string const without = whole_.substr(0, whole_.size() - 8);
  test::write_bytes(folder_ / "R.h5", without);
  EXPECT_EQ(check_seal(ReadFile(folder_ / "R.h5")), Seal::absent);
  EXPECT_NO_THROW(ResultReader reader(folder_ / "R.h5"));
  EXPECT_THROW(verify_everything(folder_ / "R.h5"), Error);
}

TEST(ByteRanges, AreDisjointAndInOrderWhateverIsAddedAndRemoved) {
  ByteRanges ranges;
  std::vector<bool> expected(64, false);
  unsigned draw = 1;
  for (int i = 0; i < 2000; ++i) {
    draw = draw * 1103515245u + 12345u;
    std::size_t const begin = (draw >> 8) % 64, end = std::min<std::size_t>(64, begin + (draw >> 16) % 9);
    bool const add = (draw >> 24) % 2 == 0;
    add ? ranges.add(begin, end) : ranges.remove(begin, end);
    std::fill(expected.begin() + static_cast<std::ptrdiff_t>(begin),
              expected.begin() + static_cast<std::ptrdiff_t>(end), add);
    std::vector<bool> found(64, false);
    std::uint64_t last = 0;
    for (auto const& range : ranges.before(60)) {
      ASSERT_TRUE(range.begin < range.end && range.end <= 60 && (last == 0 || range.begin > last))
          << "neighbours are one";
      last = range.end;
      for (auto k = range.begin; k < range.end; ++k) found[k] = true;
    }
    ASSERT_TRUE(std::equal(found.begin(), found.begin() + 60, expected.begin())) << i;
  }
}

}  // namespace file_seal_test
}  // namespace torquescope
