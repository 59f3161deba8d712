// Segments are those of the folder that was found to be this job's own, whatever its name leads to later.

#include <gtest/gtest.h>

#include <string>

#include "engine/base/error.hpp"
#include "engine/experiment/runs/saved_runs.hpp"
#include "support/temporary_folder.hpp"

namespace torquescope {
namespace segments_of_opened_folder_test {

namespace fs = std::filesystem;

HistoryShape const shape{1, 3, 0, 1};  // runs, generations, members, parameters
SegmentOrigin const origin{"job", "inputs", "program", "name", 0, 1, "", 1, 1, "now", ""};

// one whole run, whose best is this
void write_run(fs::path const& name, double best) {
  RunPart part{.run = 0, .first = 0, .count = 4, .ended = true};
  for (auto const& list : history_lists) (part.history.*list.values).resize(list.width(shape) * part.count, best);
  part.history.evaluations.assign(part.count, 1);
  part.history.parameters = {best};
  part.history.stop_reason = "target";
  write_segment(name, origin, {{"de", "search", shape, {part}}});
}

class OpenedFolder : public testing::Test {
 protected:
  OpenedFolder() {
    fs::create_directory(parts_);
    fs::create_directory(other_);
    write_run(parts_ / "shard-0.h5", 1.0);
    write_run(other_ / "shard-0.h5", 2.0);
  }
  SavedRunsRequest request() const {
    return {.own_folder = parts_, .expected = origin, .searches = {{"de", "search"}}};
  }
  static double best(SavedRuns& runs) { return runs.load("de", shape, 0)->history.parameters.front(); }

  test::TemporaryFolder folder_;
  fs::path parts_ = folder_ / "r.h5.parts", other_ = folder_ / "scratch";
};

TEST_F(OpenedFolder, IsReadWhateverItsNameLeadsToLater) {
  SavedRuns runs(request());
  fs::rename(parts_, folder_ / "moved");
  fs::create_symlink(other_, parts_);
  EXPECT_EQ(best(runs), 1.0);
  EXPECT_THROW(SavedRuns again(request()), Error) << "a link is not this job's own";
}

TEST_F(OpenedFolder, HasNoSegmentBehindALink) {
  fs::remove(parts_ / "shard-0.h5");
  fs::create_symlink(other_ / "shard-0.h5", parts_ / "shard-0.h5");
  SavedRuns runs(request());
  EXPECT_TRUE(runs.empty());
  ASSERT_EQ(runs.warnings().size(), 1u);
  EXPECT_NE(runs.warnings().front().find("shard-0.h5 is not a file"), std::string::npos) << runs.warnings().front();
}

// somebody has named it, who may have it behind a link
TEST_F(OpenedFolder, OfAnotherNodeMayBeALink) {
  fs::remove(parts_ / "shard-0.h5");
  fs::create_symlink(other_, folder_ / "node2");
  auto named = request();
  named.more_folders = {folder_ / "node2"};
  SavedRuns runs(named);
  EXPECT_TRUE(runs.has_ended("de", 0));
  EXPECT_EQ(best(runs), 2.0);
}

}  // namespace segments_of_opened_folder_test
}  // namespace torquescope
