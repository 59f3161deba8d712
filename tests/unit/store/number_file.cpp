// What is read back is right in every bit, or it is not read.

#include "engine/store/number_file.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <array>
#include <cmath>
#include <limits>

#include "engine/base/error.hpp"
#include "support/temporary_folder.hpp"

namespace torquescope {
namespace number_file_test {

namespace fs = std::filesystem;

std::array<double, 5> const numbers{1.0, -0.0, std::numeric_limits<double>::infinity(), 5e-324, -3.25};
Sha256 const job = Digest().text("this job").raw();
NumberFileKey const key{job, Digest().text("this one").raw()};

NumberFile found(fs::path const& name, NumberFileKey const& wanted = key, std::size_t count = numbers.size()) {
  std::vector<double> read(count);
  return read_number_file(name, wanted, read);
}

TEST(NumberFile, GivesBackEveryBit) {
  test::TemporaryFolder const folder;
  write_number_file(folder / "a", key, numbers);
  std::array<double, 5> read{};
  ASSERT_EQ(read_number_file(folder / "a", key, read), NumberFile::whole);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    EXPECT_EQ(read[i], numbers[i]);
    EXPECT_EQ(std::signbit(read[i]), std::signbit(numbers[i]));
  }
  EXPECT_EQ(fs::file_size(folder / "a"), number_file_bytes(numbers.size()));
  EXPECT_EQ(folder.n_files(), 1u) << "nothing unfinished is left";
}

TEST(NumberFile, OfNoNumbersIsWhole) {
  test::TemporaryFolder const folder;
  write_number_file(folder / "a", key, {});
  EXPECT_EQ(found(folder / "a", key, 0), NumberFile::whole);
}

TEST(NumberFile, IsNotBelievedWithAnyBitFlippedAnyByteMissingOrOneTooMany) {
  test::TemporaryFolder const folder;
  write_number_file(folder / "a", key, numbers);
  std::string const whole = test::bytes_of(folder / "a");
  for (std::size_t bit = 0; bit < 8 * whole.size(); ++bit) {
    std::string flipped = whole;
    flipped[bit / 8] = static_cast<char>(flipped[bit / 8] ^ (1 << (bit % 8)));
    EXPECT_NE(found(folder.write("b", flipped)), NumberFile::whole) << bit;
  }
  for (std::size_t size = 0; size < whole.size(); ++size)
    EXPECT_EQ(found(folder.write("c", whole.substr(0, size))), size < 80 ? NumberFile::foreign : NumberFile::damaged)
        << size;
  EXPECT_EQ(found(folder.write("d", whole + 'x')), NumberFile::damaged);
}

TEST(NumberFile, OfAnotherKeyOrCountIsNotTaken) {
  test::TemporaryFolder const folder;
  write_number_file(folder / "a", key, numbers);
  Sha256 const another = Digest().text("another").raw();
  EXPECT_EQ(found(folder / "a", {job, another}), NumberFile::outdated);
  EXPECT_EQ(found(folder / "a", {another, key.key}), NumberFile::foreign) << "of another job";
  EXPECT_EQ(found(folder / "a", key, numbers.size() - 1), NumberFile::damaged);
  EXPECT_EQ(found(folder / "a", key, numbers.size() + 1), NumberFile::damaged);
}

TEST(NumberFile, ThatIsNoFileIsNeitherReadNorWaitedFor) {
  test::TemporaryFolder const folder;
  EXPECT_EQ(found(folder / "nothing"), NumberFile::missing);
  fs::create_directory(folder / "folder");
  EXPECT_EQ(found(folder / "folder"), NumberFile::foreign);
  ASSERT_EQ(::mkfifo((folder / "fifo").c_str(), 0600), 0);
  EXPECT_EQ(found(folder / "fifo"), NumberFile::foreign);
  write_number_file(folder / "a", key, numbers);
  fs::create_symlink("a", folder / "link");
  EXPECT_EQ(found(folder / "link"), NumberFile::foreign);
}

TEST(NumberFile, ThatCannotBeWrittenIsSaid) { EXPECT_THROW(write_number_file("/nowhere/at/all", key, numbers), Error); }

}  // namespace number_file_test
}  // namespace torquescope
