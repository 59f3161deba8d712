// What is opened at all: regular files of a bearable size; gzip bombs and stumps are refused.

#include <sys/stat.h>
#include <zlib.h>

#include <set>

#include "engine/data/file_bytes.hpp"
#include "engine/data/gunzip.hpp"
#include "unit/data/data_test_support.hpp"

namespace torquescope {
namespace files_test {

using data_test::problem_of;
using data_test::recording_section;
using data_test::write;

std::string gzipped(std::string const& text) {
  auto const path = data_test::folder() / "packed.gz";
  gzFile file = gzopen(path.c_str(), "wb");
  gzwrite(file, text.data(), static_cast<unsigned>(text.size()));
  gzclose(file);
  return read_whole_file(path);
}

TEST(ReadTable, MissingFileNamesTheClosestAndTheJobLine) {
  write("arm.csv", "t,q\n0,1\n");
  auto section = recording_section();
  section.settings[0].value = std::vector<std::string>{"arn.csv"};
  auto const problem = problem_of([&] { read_table(data_test::folder() / "arn.csv", section); });
  EXPECT_EQ(problem.code, ExitCode::no_input);
  EXPECT_TRUE(problem.what.starts_with("no file ") && problem.what.ends_with("arn.csv"));
  EXPECT_EQ(problem.help, "did you mean \"arm.csv\"?");
  EXPECT_EQ(problem.place.file, "job.toml");
  EXPECT_EQ(problem.place.line, 6);
}

TEST(ReadTable, FolderAndPipeAreRefusedWithoutWaiting) {
  auto const a_folder = problem_of([&] { read_table(data_test::folder().path(), recording_section()); });
  EXPECT_EQ(a_folder.code, ExitCode::no_input);
  EXPECT_TRUE(a_folder.what.ends_with("is a folder, not a recording"));

  auto const path = data_test::folder() / "pipe.csv";
  ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
  auto const a_pipe = problem_of([&] { read_table(path, recording_section()); });
  EXPECT_TRUE(a_pipe.what.ends_with("is a pipe, not a recording"));
  EXPECT_EQ(problem_of([&] { read_table("/dev/zero", recording_section()); }).code, ExitCode::no_input);
}

TEST(ReadWholeFile, RefusesMoreThanItsLimit) {
  auto const path = write("big.csv", std::string(3 << 20, '1'));
  EXPECT_EQ(read_whole_file(path, 3 << 20).size(), std::size_t{3 << 20});
  auto const problem = problem_of([&] { read_whole_file(path, (3 << 20) - 1); });
  EXPECT_EQ(problem.code, ExitCode::bad_data);
  EXPECT_NE(problem.what.find("is larger than 2 MiB"), std::string::npos);
}

TEST(GunzipText, GivesBackWhatWasPackedInAnyNumberOfMembers) {
  std::string const text(100000, 'x');
  EXPECT_EQ(gunzip_text(gzipped(text), "a.gz"), text);
  EXPECT_EQ(gunzip_text(gzipped("ab") + gzipped("cd") + std::string(512, '\0'), "a.gz"), "abcd");
  EXPECT_EQ(gunzip_text(gzipped(""), "a.gz"), "");
}

TEST(GunzipText, RefusesBombsStumpsAndDamage) {
  auto const bomb = problem_of([&] { gunzip_text(gzipped(std::string(8 << 20, '1')), "a.gz", 1 << 20); });
  EXPECT_EQ(bomb.code, ExitCode::bad_data);
  EXPECT_EQ(bomb.what, "a.gz unpacks to more than 1 MiB");

  auto const zeros = problem_of([&] { gunzip_text(gzipped(std::string(1 << 20, '\0')), "a.gz"); });
  EXPECT_NE(zeros.what.find("is not text"), std::string::npos);

  auto packed = gzipped(std::string(100000, 'x') + "tail");
  auto const stump = problem_of([&] { gunzip_text(packed.substr(0, packed.size() / 2), "a.gz"); });
  EXPECT_EQ(stump.what, "a.gz ends in the middle of its gzip data");
  packed[packed.size() - 6] = static_cast<char>(packed[packed.size() - 6] ^ 1);  // in the checksum
  EXPECT_NE(problem_of([&] { gunzip_text(packed, "a.gz"); }).what.find("is damaged gzip"), std::string::npos);
  EXPECT_NE(problem_of([&] { gunzip_text(gzipped("ab") + "rubbish", "a.gz"); }).what.find("is damaged gzip"),
            std::string::npos);
}

TEST(EveryReader, HasANameAndAMeaningOfItsOwn) {
  std::set<std::string> names;
  for (auto const& reader : reader_choices()) {
    EXPECT_TRUE(names.insert(reader.name).second);
    EXPECT_FALSE(reader.meaning.empty());
  }
  EXPECT_EQ(names, (std::set<std::string>{"csv", "hdf5", "json", "mat5", "npz", "ros_echo"}));
}

}  // namespace files_test
}  // namespace torquescope
