// Every process gets every replicate of a batch, whoever computed it: alone, late, beside others, after kills, and when
// files are missing, damaged or of another diagnosis. Twins here are numbers that name their place.

#include "engine/workflows/twin_folder.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>  // NOLINT(modernize-deprecated-headers): kill is POSIX, <csignal> does not promise it
#include <sys/file.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "engine/base/error.hpp"
#include "engine/simulate/twin_lanes.hpp"
#include "support/temporary_folder.hpp"

namespace torquescope {
namespace twin_folder_test {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

constexpr std::size_t first_twin = twin_lanes, last_twin = 7 * twin_lanes + 3;  // the last group is not full
constexpr std::size_t numbers = 3;

double number_of(std::size_t twin, std::size_t k) { return 100.0 * static_cast<double>(twin) + static_cast<double>(k); }

// one process's side of a batch
struct Twins {
  std::vector<double> values = std::vector<double>(last_twin * numbers, -1.0);
  std::size_t computed = 0;
  std::function<void(TwinRange const&)> before = [](TwinRange const&) {};

  TwinBatch batch(std::string const& identity = "one") {
    return {identity,
            {first_twin, last_twin},
            1000,
            numbers,
            [this](TwinRange const& range) {
              before(range);
              computed += range.size();
              for (std::size_t twin = range.from; twin < range.to; ++twin)
                for (std::size_t k = 0; k < numbers; ++k) values[twin * numbers + k] = number_of(twin, k);
            },
            [this](std::size_t twin, std::span<double> out) {
              std::copy_n(values.data() + twin * numbers, numbers, out.data());
            },
            [this](std::size_t twin, std::span<double const> in) {
              std::copy_n(in.data(), numbers, values.data() + twin * numbers);
            }};
  }

  bool are_all_there() const {
    for (std::size_t twin = 0; twin < last_twin; ++twin)
      for (std::size_t k = 0; k < numbers; ++k)
        if (values[twin * numbers + k] != (twin < first_twin ? -1.0 : number_of(twin, k))) return false;
    return true;
  }
};
constexpr std::size_t all_twins = last_twin - first_twin;

class SharedTwins : public testing::Test {
 protected:
  SharedTwins() { fs::create_directory(parts()); }

  fs::path parts() const { return folder_ / "R.h5.parts"; }
  std::vector<fs::path> files() const {
    std::vector<fs::path> names;
    for (auto const& entry : fs::directory_iterator(parts())) names.push_back(entry.path());
    std::sort(names.begin(), names.end());
    return names;
  }
  TwinFolder::Setting setting(std::size_t index = 0, std::size_t count = 3) {
    TwinFolder::Setting result;
    result.result = folder_ / "R.h5";
    result.shard = {index, count, "test"};
    result.inputs_sha256 = "inputs";
    result.least_gain = 0.0;
    result.tell = [this](std::string const&, std::string const& text) { told_ += text + "\n"; };
    return result;
  }
  // how many replicates one more process had to compute
  std::size_t computed_by_another(TwinFolder::Setting const& of) {
    Twins twins;
    TwinFolder folder(of);
    folder.fill(twins.batch());
    EXPECT_TRUE(twins.are_all_there());
    return twins.computed;
  }

  test::TemporaryFolder folder_;
  std::string told_;
};

TEST_F(SharedTwins, AreAllMadeByOneAloneAndTakenByWhoComesLater) {
  EXPECT_EQ(computed_by_another(setting(1)), all_twins);
  EXPECT_EQ(files().size(), 3u);
  EXPECT_EQ(computed_by_another(setting(0)), 0u);
  EXPECT_EQ(computed_by_another(setting(1)), 0u) << "the same command again";
  EXPECT_EQ(told_, "");
}

TEST_F(SharedTwins, AreSimulatedAgainWhereAPartIsMissingDamagedOrForeign) {
  static_cast<void>(computed_by_another(setting()));
  auto const names = files();
  std::string const whole = test::bytes_of(names[0]);
  fs::remove(names[0]);
  EXPECT_EQ(computed_by_another(setting()), 2 * twin_lanes);
  EXPECT_EQ(test::bytes_of(names[0]), whole);

  std::string damaged = whole;
  damaged[damaged.size() / 2] ^= 1;
  test::write_bytes(names[0], damaged);
  EXPECT_EQ(computed_by_another(setting()), 2 * twin_lanes);
  EXPECT_NE(told_.find(names[0].string() + " is damaged"), std::string::npos);
  EXPECT_EQ(test::bytes_of(names[0]), whole);

  // one part where another belongs
  test::write_bytes(names[0], test::bytes_of(names[1]));
  EXPECT_EQ(computed_by_another(setting()), 2 * twin_lanes);
  EXPECT_EQ(test::bytes_of(names[0]), whole);

  // somebody's own file of that name
  test::write_bytes(names[0], "my own words");
  EXPECT_EQ(computed_by_another(setting()), 2 * twin_lanes);
  EXPECT_NE(told_.find(names[0].string() + " is no part of this diagnosis"), std::string::npos);
  EXPECT_EQ(test::bytes_of(names[0]), "my own words");
  test::write_bytes(names[0], whole);

  auto other_recording = setting();
  other_recording.inputs_sha256 = "other inputs";
  EXPECT_EQ(computed_by_another(other_recording), all_twins);
  EXPECT_EQ(files().size(), 6u) << "of two jobs";
  Twins twins;
  TwinFolder(setting()).fill(twins.batch("another batch"));
  EXPECT_EQ(twins.computed, all_twins);
}

TEST_F(SharedTwins, OfTwoAtOnceAreComputedOnceEach) {
  Twins one, other;
  one.before = other.before = [](TwinRange const& range) { std::this_thread::sleep_for(1ms * range.size()); };
  std::thread beside([&] { TwinFolder(setting(1, 2)).fill(other.batch()); });
  TwinFolder(setting(0, 2)).fill(one.batch());
  beside.join();
  EXPECT_TRUE(one.are_all_there());
  EXPECT_TRUE(other.are_all_there());
  EXPECT_EQ(one.computed + other.computed, all_twins);
}

TEST_F(SharedTwins, OfAProcessThatIsKilledAreComputedByAnother) {
  pid_t const child = ::fork();
  if (child == 0) {
    Twins twins;
    twins.before = [](TwinRange const&) {
      while (true) ::pause();
    };
    TwinFolder(setting(0, 2)).fill(twins.batch());
    ::_exit(0);
  }
  while (files().empty()) std::this_thread::sleep_for(1ms);
  std::thread killer([child] {
    std::this_thread::sleep_for(100ms);
    ::kill(child, SIGKILL);
  });
  Twins twins;
  auto const start = std::chrono::steady_clock::now();
  TwinFolder(setting(1, 2)).fill(twins.batch());
  EXPECT_GE(std::chrono::steady_clock::now() - start, 50ms) << "the living are waited for";
  killer.join();
  ::waitpid(child, nullptr, 0);
  EXPECT_TRUE(twins.are_all_there());
  EXPECT_EQ(twins.computed, all_twins);
}

TEST_F(SharedTwins, AreWaitedForNoLongerThanIsWanted) {
  static_cast<void>(computed_by_another(setting()));
  fs::path const missing = files().front();
  fs::remove(missing);
  int const held = ::open((missing.string() + ".lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
  ASSERT_EQ(::flock(held, LOCK_EX), 0);
  auto impatient = setting();
  auto const start = std::chrono::steady_clock::now();
  impatient.must_end = [start] { return std::chrono::steady_clock::now() - start > 50ms; };
  Twins twins;
  EXPECT_THROW(TwinFolder(impatient).fill(twins.batch()), TwinsAbandoned);
  EXPECT_EQ(twins.computed, 0u);
  ::close(held);
}

TEST_F(SharedTwins, OfSmallBatchesMakeNoFiles) {
  auto frugal = setting();
  frugal.least_gain = 0.5 * static_cast<double>(all_twins) * 1000.0 + 1.0;
  EXPECT_EQ(computed_by_another(frugal), all_twins);
  EXPECT_TRUE(files().empty());
  Twins twins;
  TwinBatch group = twins.batch();
  group.range.to = group.range.from + twin_lanes;
  TwinFolder(setting()).fill(group);
  EXPECT_EQ(twins.computed, twin_lanes);
  EXPECT_TRUE(files().empty()) << "replicates of one group are simulated together";
}

TEST_F(SharedTwins, DoNotNeedTheDisk) {
  auto full = setting();
  full.bytes_kept_free = std::uintmax_t{1} << 60;
  EXPECT_EQ(computed_by_another(full), all_twins);
  EXPECT_TRUE(files().empty());
  EXPECT_NE(told_.find("little room"), std::string::npos);
  fs::remove(parts());
  EXPECT_EQ(computed_by_another(setting()), all_twins);
}

TEST_F(SharedTwins, FailAsTheyWouldAlone) {
  Twins twins;
  twins.before = [](TwinRange const& range) {
    if (range.to > 3 * twin_lanes)
      throw Error(Problem{ExitCode::bad_data, range.from == first_twin ? "first" : "later"});
  };
  try {
    TwinFolder(setting(2)).fill(twins.batch());
    FAIL() << "nothing failed";
  } catch (Error const& error) {
    EXPECT_STREQ(error.what(), Error(Problem{ExitCode::bad_data, "first"}).what());
  }
}

}  // namespace twin_folder_test
}  // namespace torquescope
