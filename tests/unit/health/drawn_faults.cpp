// How many faults of each kind are found in recordings that nobody has looked at, and that sound ones have none.
//
// Prints the board of rates. Some faults cannot be seen: repeats below an encoder's step, a magnitude of dry friction
// alone, which never comes down to zero. Three in four must be found of every kind

#include <gtest/gtest.h>

#include <cstdio>

#include "engine/base/error.hpp"
#include "engine/data/health/finding_text.hpp"
#include "engine/data/health/make_recording.hpp"
#include "unit/health/fault_generator.hpp"

namespace torquescope {
namespace drawn_faults_test {

using namespace health_test;

constexpr unsigned recordings = 40;  // of each kind

Section job_section(std::vector<std::string> const& written) {
  Section section{"recording", {}, {}};
  for (auto const& key : written) section.settings.push_back({key, OptionValue(1.0), {}, {}});
  return section;
}

// what the examination says; an error stands for the words of its problem
struct Said {
  bool is_told = false;
  std::string others{};
};

Said examined(FaultKind const& kind, unsigned number) {
  auto drawn = draw_recording(number);
  kind.put(drawn);
  Said said;
  try {
    for (auto const& finding : make_recording(drawn.table, drawn.options, job_section(kind.written)).findings) {
      bool const is_told = std::find(kind.told_as.begin(), kind.told_as.end(), finding.kind) != kind.told_as.end();
      said.is_told = said.is_told || is_told;
      if (!is_told && finding.grade != Grade::note) said.others += " " + code_of(finding.kind);
    }
  } catch (Error const& error) {
    said.others += " error: " + error.problems().front().what;
  }
  return said;
}

TEST(DrawnFaults, AreFoundThreeTimesInFour) {
  for (auto const& kind : fault_kinds()) {
    unsigned told = 0;
    std::string missed;
    for (unsigned number = 1; number <= recordings; ++number) {
      auto const said = examined(kind, number);
      told += said.is_told;
      if (!said.is_told) missed += "\n      " + std::to_string(number) + ":" + said.others;
    }
    std::printf("%-46s %2u of %u%s\n", kind.name, told, recordings, missed.c_str());
    EXPECT_GE(told, recordings * 3 / 4) << kind.name;
  }
}

TEST(DrawnFaults, SoundRecordingsHaveNone) {
  unsigned quiet = 0, all = 0;
  for (unsigned number = 1; number <= 200; ++number)
    for (bool const with_velocity : {false, true}) {
      auto drawn = draw_recording(number);
      if (with_velocity) drawn.options.columns["velocity"] = "qd_radps";
      auto const recording = make_recording(drawn.table, drawn.options, job_section({}));
      ++all;
      bool is_quiet = true;
      for (auto const& finding : recording.findings)
        if (finding.grade != Grade::note) {
          is_quiet = false;
          ADD_FAILURE() << number << ": " << sentence_of(finding);
        }
      quiet += is_quiet;
    }
  std::printf("sound recordings without a warning: %u of %u\n", quiet, all);
}

}  // namespace drawn_faults_test
}  // namespace torquescope
