// Names that never meet, and tidying up that takes nothing from a process that still writes.

#include "engine/store/segment_folder.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <functional>

#include "engine/base/error.hpp"
#include "engine/store/file_seal.hpp"
#include "engine/store/result_writer.hpp"
#include "engine/store/shard_lock.hpp"
#include "engine/store/temp_file.hpp"
#include "support/temporary_folder.hpp"

namespace torquescope {
namespace segment_folder_test {

namespace fs = std::filesystem;

TEST(SegmentFolder, StandsBesideTheResult) {
  EXPECT_EQ(segment_folder_of("out/R.h5"), fs::path("out/R.h5.parts"));
  test::TemporaryFolder const folder;
  fs::path const parts = segment_folder_of(folder / "R.h5");
  EXPECT_TRUE(segments_in(OpenFolder(parts)).empty());
  make_segment_folder(parts);
  make_segment_folder(parts);
  EXPECT_TRUE(fs::is_directory(parts));
  EXPECT_THROW(make_segment_folder(folder / "no" / "such"), Error);
}

TEST(SegmentNames, TellShardAndNumberAndNeverMeet) {
  ShardChoice const shard{3, 10};
  SegmentNames one("f", shard), other("f", shard);
  fs::path const first = one.next(), second = one.next();
  EXPECT_NE(first, second);
  EXPECT_LT(first, second);
  EXPECT_EQ(first.filename().string().rfind("shard-0003-of-0010.", 0), 0u);
  EXPECT_EQ(first.extension(), ".h5");
}

void write_sealed(fs::path const& name, std::string const& inputs_sha256, Keeps keeps = Keeps::work) {
  ResultWriter writer(name, {.inputs_sha256 = inputs_sha256, .keeps = keeps});
  writer.numbers("/x", {3}, std::vector<double>{1.0, 2.0, 3.0}, {"1", "numbers"});
  writer.finish();
}

class RemoveSegments : public testing::Test {
 protected:
  RemoveSegments() { make_segment_folder(parts_); }

  test::TemporaryFolder folder_;
  fs::path result_ = folder_ / "R.h5", parts_ = segment_folder_of(result_);
};

TEST_F(RemoveSegments, TakesThoseOfTheJobAndWhatTheDeadLeft) {
  write_sealed(parts_ / "shard-0000-of-0001.a.h5", "job");
  for (auto const* name : {"R.h5.parts/shard-0.h5.tmp.12", "R.h5.parts/shard-0000-of-0001.lock"})
    folder_.write(name, "");
  folder_.write("R.h5.parts/shard-0001-of-0002.lock", "process 12 on node7");
  folder_.write("R.h5.parts/shard-0002-of-0003.lock", std::string(19, '\0'));  // its power went
  for (auto const* name : {"R.h5.tmp.99", "R.h5.made.json.tmp.7", "S.h5.tmp.9", "R.h5.tmp.backup", "R.h5.tmp.1.txt"})
    folder_.write(name, "x");
  TempFile const living(result_);
  EXPECT_TRUE(remove_segments(result_, "job").empty());
  EXPECT_FALSE(fs::exists(parts_));
  EXPECT_FALSE(fs::exists(folder_ / "R.h5.tmp.99"));
  EXPECT_FALSE(fs::exists(folder_ / "R.h5.made.json.tmp.7"));
  for (auto const* name : {"S.h5.tmp.9", "R.h5.tmp.backup", "R.h5.tmp.1.txt"})
    EXPECT_TRUE(fs::exists(folder_ / name)) << name << " is somebody else's";
  EXPECT_TRUE(fs::exists(living.temporary_name())) << "its process lives";
}

TEST_F(RemoveSegments, LeavesWhateverDoesNotSayThatItIsOfTheJob) {
  write_sealed(parts_ / "shard-0000-of-0001.other.h5", "another job");
  write_sealed(parts_ / "shard-0000-of-0001.nobody.h5", "");
  write_sealed(parts_ / "copy.h5", "job", Keeps::result);
  write_sealed(folder_ / "elsewhere.h5", "job");
  fs::create_symlink("../elsewhere.h5", parts_ / "shard-0000-of-0001.link.h5");
  std::vector<std::string> const written{"notmine.h5", "notes.txt", "notes.tmp.txt", "mine.h5.tmp.12",
                                         "shard-0000-of-0001.lock"};
  for (auto const& name : written) folder_.write("R.h5.parts/" + name, "my own words");
  auto const n_before = std::distance(fs::directory_iterator(parts_), {});
  auto const warnings = remove_segments(result_, "job");
  EXPECT_EQ(std::distance(fs::directory_iterator(parts_), {}), n_before);
  EXPECT_TRUE(fs::exists(folder_ / "elsewhere.h5"));
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("5 of the files"), std::string::npos) << warnings[0];
  remove_segments(result_, "");
  EXPECT_EQ(std::distance(fs::directory_iterator(parts_), {}), n_before) << "of no job";
}

TEST_F(RemoveSegments, NeverGoesThroughALinkOrIntoTheFolderOfAnother) {
  fs::rename(parts_, folder_ / "scratch");
  fs::create_directory_symlink("scratch", parts_);
  write_sealed(folder_ / "scratch" / "shard-0000-of-0001.a.h5", "job");
  auto const warnings = remove_segments(result_, "job");
  EXPECT_TRUE(fs::exists(folder_ / "scratch" / "shard-0000-of-0001.a.h5"));
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("is a symbolic link"), std::string::npos) << warnings[0];
  for (auto const& refused : {std::function<void()>([&] { make_segment_folder(parts_); }),
                              std::function<void()>([&] { refuse_foreign_folder(parts_); }),
                              std::function<void()>([&] { ShardLock const lock(result_, {}); })}) {
    try {
      refused();
      ADD_FAILURE() << "not refused";
    } catch (Error const& error) {
      EXPECT_EQ(error.code(), ExitCode::exists);
    }
  }
  fs::remove(parts_);
  fs::rename(folder_ / "scratch", parts_);
  if (::geteuid() != 0) GTEST_SKIP() << "only root can give a folder away";
  ASSERT_EQ(::chown(parts_.c_str(), 12345, 12345), 0);
  EXPECT_THROW(refuse_foreign_folder(parts_), Error);
  EXPECT_NE(remove_segments(result_, "job").at(0).find("belongs to another user"), std::string::npos);
  EXPECT_TRUE(fs::exists(parts_ / "shard-0000-of-0001.a.h5"));
}

}  // namespace segment_folder_test
}  // namespace torquescope
