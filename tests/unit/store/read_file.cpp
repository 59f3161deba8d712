// What is read is of the file that was opened, whatever its name leads to by then.

#include "engine/store/read_file.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cerrno>
#include <string>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/store/open_folder.hpp"
#include "engine/store/result_reader.hpp"
#include "support/temporary_folder.hpp"
#include "unit/store/example_result.hpp"

namespace torquescope {
namespace read_file_test {

namespace fs = std::filesystem;

ExitCode opening(FilePlace const& place) {
  try {
    ReadFile const file(place);
    return ExitCode::ok;
  } catch (Error const& error) {
    return error.code();
  }
}

std::string content(ReadFile const& file) {
  std::string bytes(file.size(), '\0');
  EXPECT_TRUE(read_at(file.descriptor(), 0, bytes.data(), bytes.size()));
  return bytes;
}

TEST(ReadFile, FollowsLinksUnderAPathAndNoneInAnOpenFolder) {
  test::TemporaryFolder const folder;
  folder.write("a", "bytes");
  fs::create_symlink(folder / "a", folder / "link");
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  OpenFolder const open(folder.path());
  EXPECT_EQ(content(ReadFile(folder / "link")), "bytes");
  EXPECT_EQ(opening(open.place("link")), ExitCode::bad_data);
  for (auto const& place : {FilePlace(folder / "pipe"), open.place("pipe"), FilePlace(folder.path())})
    EXPECT_EQ(opening(place), ExitCode::bad_data) << place.path;
  for (auto const& place : {FilePlace(folder / "b"), open.place("b"), FilePlace(folder / "a" / "b")})
    EXPECT_EQ(opening(place), ExitCode::no_input) << place.path;
}

TEST(ReadFile, StaysTheFileThatWasOpened) {
  test::TemporaryFolder const folder;
  ReadFile const file(folder.write("a", "first"));
  folder.write("b", "other");
  fs::rename(folder / "b", folder / "a");
  EXPECT_EQ(content(file), "first");
  char more = '?';
  EXPECT_FALSE(read_at(file.descriptor(), file.size(), &more, 1)) << "behind its end";
}

// with HDF5 between: its own driver would open the name
TEST(ResultReader, ReadsTheFileThatWasOpened) {
  test::TemporaryFolder const folder;
  example::write_result(folder / "R.h5");
  std::string const written = verify_result(folder / "R.h5");
  ResultReader const reader(folder / "R.h5");
  folder.write("other", "no HDF5 at all");
  fs::rename(folder / "other", folder / "R.h5");
  EXPECT_EQ(reader.verify(), written);
  EXPECT_THROW(verify_result(folder / "R.h5"), Error);
}

// a folder of the same name is another folder
TEST(OpenFolder, IsTheFolderThatWasOpened) {
  test::TemporaryFolder const folder;
  fs::create_directory(folder / "parts");
  folder.write("parts/a", "mine");
  OpenFolder const open(folder / "parts");
  fs::rename(folder / "parts", folder / "moved");
  fs::create_directory(folder / "parts");
  folder.write("parts/a", "another's");
  folder.write("parts/b", "another's");
  EXPECT_EQ(open.names(), std::vector<std::string>{"a"});
  EXPECT_EQ(content(ReadFile(open.place("a"))), "mine");
}

TEST(OpenFolder, SaysWhyItHasNoNames) {
  test::TemporaryFolder const folder;
  auto const none = OpenFolder(folder / "none").listing();
  EXPECT_EQ(none.error_number, ENOENT);
  EXPECT_TRUE(none.names.empty());
  EXPECT_EQ(OpenFolder(folder.write("file", "")).listing().error_number, ENOTDIR);
  EXPECT_EQ(OpenFolder(folder.path()).listing().error_number, 0);
}

}  // namespace read_file_test
}  // namespace torquescope
