// Names that never meet, and tidying up that takes nothing from a process that still writes.

#include "engine/store/segment_folder.hpp"

#include <gtest/gtest.h>

#include "engine/base/error.hpp"
#include "engine/store/temp_file.hpp"
#include "support/temporary_folder.hpp"

namespace torquescope {
namespace segment_folder_test {

namespace fs = std::filesystem;

TEST(SegmentFolder, StandsBesideTheResult) {
  EXPECT_EQ(segment_folder_of("out/R.h5"), fs::path("out/R.h5.parts"));
  test::TemporaryFolder const folder;
  fs::path const parts = segment_folder_of(folder / "R.h5");
  EXPECT_TRUE(segments_in(parts).empty());
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

TEST(RemoveSegments, TakesSegmentsAndWhatTheDeadLeftAndNothingElse) {
  test::TemporaryFolder const folder;
  fs::path const result = folder / "R.h5", parts = segment_folder_of(result);
  make_segment_folder(parts);
  for (auto const* name :
       {"R.h5.parts/a.h5", "R.h5.parts/b.h5.tmp.12", "R.h5.parts/c.twins", "R.h5.parts/d.twins.tmp.3.1",
        "R.h5.parts/d.twins.lock", "R.h5.tmp.99", "R.h5.made.json.tmp.7", "S.h5.tmp.9"})
    folder.write(name, "x");
  TempFile const living(result);
  remove_segments(result);
  EXPECT_FALSE(fs::exists(parts));
  EXPECT_FALSE(fs::exists(folder / "R.h5.tmp.99"));
  EXPECT_FALSE(fs::exists(folder / "R.h5.made.json.tmp.7"));
  EXPECT_TRUE(fs::exists(folder / "S.h5.tmp.9")) << "of another result";
  EXPECT_TRUE(fs::exists(living.temporary_name())) << "its process lives";

  make_segment_folder(parts);
  for (auto const* mine : {"notes.txt", "notes.tmp.txt"}) folder.write("R.h5.parts/" + std::string(mine), "mine");
  remove_segments(result);
  for (auto const* mine : {"notes.txt", "notes.tmp.txt"}) EXPECT_TRUE(fs::exists(parts / mine));
}

}  // namespace segment_folder_test
}  // namespace torquescope
