// Whatever is written where and in which order: the file holds what a plain array of bytes would.

#include "engine/store/temp_file.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include "engine/base/error.hpp"
#include "engine/store/own_folder.hpp"
#include "support/temporary_folder.hpp"

namespace torquescope {
namespace temp_file_test {

class Numbers {
 public:
  explicit Numbers(std::uint32_t state) : state_(state) {}
  std::size_t below(std::size_t end) {
    state_ = state_ * 1664525U + 1013904223U;
    return static_cast<std::size_t>(std::uint64_t{state_} * end >> 32);
  }

 private:
  std::uint32_t state_;
};

struct FileAndArray {
  explicit FileAndArray(std::filesystem::path const& name) : file(name) {}

  void write(std::size_t offset, std::size_t size, char letter) {
    std::string const bytes(size, letter);
    file.write_at(offset, bytes.data(), size);
    if (array.size() < offset + size) array.resize(offset + size, '\0');
    array.replace(offset, size, bytes);
  }
  void expect_read(std::size_t offset, std::size_t size) {
    std::string bytes(size, 'x');
    ASSERT_TRUE(file.read_at(offset, bytes.data(), size));
    std::string expected = offset < array.size() ? array.substr(offset, size) : "";
    expected.resize(size, '\0');
    EXPECT_TRUE(bytes == expected) << offset << " " << size;
  }
  void resize(std::size_t size) {
    file.resize(size);
    array.resize(size, '\0');
  }

  TempFile file;
  std::string array;
};

TEST(TempFile, HoldsWhatWasWrittenInAnyOrder) {
  test::TemporaryFolder const folder;
  for (std::uint32_t seed = 1; seed <= 12; ++seed) {
    FileAndArray both(folder / "R");
    Numbers numbers(seed);
    for (int step = 0; step < 60; ++step) {
      std::size_t const end = both.array.size();
      auto const letter = static_cast<char>('a' + numbers.below(26));
      switch (numbers.below(8)) {
        case 0:  // over what is there, or across the end
          both.write(numbers.below(end + 1), numbers.below(3000), letter);
          break;
        case 1:  // with a gap
          both.write(end + numbers.below(5000), 1 + numbers.below(500), letter);
          break;
        case 2:
          both.expect_read(numbers.below(end + 1), numbers.below(700'000));
          break;
        case 3:
          if (step % 5 == 0) both.resize(end - std::min(end, numbers.below(900'000)));
          break;
        case 4:
          both.resize(end + numbers.below(20'000));
          break;
        default:  // as results grow
          both.write(end, numbers.below(400'000), letter);
      }
      ASSERT_EQ(both.file.size(), both.array.size());
    }
    both.file.publish();
    EXPECT_TRUE(test::bytes_of(folder / "R") == both.array) << "seed " << seed;
  }
  EXPECT_EQ(folder.n_files(), 1U);
}

TEST(TempFile, TakesLongWritesAndWholePages) {
  test::TemporaryFolder const folder;
  for (std::size_t size : {std::size_t{1}, std::size_t{4096}, std::size_t{1} << 19, (std::size_t{1} << 19) + 1,
                           std::size_t{1} << 22, (std::size_t{1} << 22) - 1}) {
    FileAndArray both(folder / "R");
    both.write(0, size, 'a');
    both.write(size / 2, 1, 'b');
    both.write(0, 1, 'c');
    both.file.publish();
    EXPECT_TRUE(test::bytes_of(folder / "R") == both.array) << size;
  }
}

TEST(TempFile, LeavesNothingWhenItIsGivenUpWhileItsThreadWrites) {
  test::TemporaryFolder const folder;
  for (int i = 0; i < 20; ++i) {
    FileAndArray both(folder / "R");
    both.write(0, std::size_t{3} << 20, 'a');
  }
  EXPECT_EQ(folder.n_files(), 0U);
}

TEST(TempFile, StaysInTheFolderThatWasOpenedWhateverItsNameLeadsToNow) {
  test::TemporaryFolder const folder;
  std::filesystem::path const ours = folder / "ours", moved = folder / "moved", foreign = folder / "foreign";
  for (auto const& made : {ours, foreign}) std::filesystem::create_directory(made);
  OwnFolder const opened(ours);
  TempFile published(opened.place("published"));
  std::filesystem::rename(ours, moved);
  std::filesystem::create_directory_symlink(foreign, ours);
  published.write_at(0, "x", 1);
  published.publish();
  { TempFile const given_up(opened.place("given_up")); }
  EXPECT_EQ(test::bytes_of(moved / "published"), "x");
  EXPECT_FALSE(std::filesystem::exists(moved / ("given_up.tmp." + std::to_string(::getpid()))));
  EXPECT_TRUE(std::filesystem::is_empty(foreign));
}

TEST(OwnFolder, ThatIsNotThereTakesNoFile) {
  test::TemporaryFolder const folder;
  OwnFolder const missing(folder / "missing");
  EXPECT_FALSE(missing.is_open());
  EXPECT_THROW(static_cast<void>(missing.place("file")), Error);
}

}  // namespace temp_file_test
}  // namespace torquescope
