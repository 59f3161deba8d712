// A reference that holds a stop code is no command, and no register without its sign; every coding that is advised can
// be written.

#include <gmock/gmock.h>

#include <algorithm>
#include <limits>

#include "engine/data/health/finding_text.hpp"
#include "engine/data/health/make_recording.hpp"
#include "engine/data/health/register_coding.hpp"
#include "unit/health/sample_recording.hpp"

namespace torquescope {
namespace stop_codes_test {

using health_test::sample_options;
using health_test::sample_table;
using testing::HasSubstr;

// the position is its own reference, but for the rows from `first` to `last`, a share each
Recording with_code(double code, double first, double last) {
  auto table = sample_table();
  auto options = sample_options();
  options.columns["reference"] = "q_ref";
  auto reference = table.columns[1];
  auto const rows = static_cast<double>(reference.size());
  for (std::size_t i = 0; i < reference.size(); ++i)
    if (static_cast<double>(i) >= first * rows && static_cast<double>(i) < last * rows) reference[i] = code;
  table.names.push_back("q_ref");
  table.columns.push_back(std::move(reference));
  return make_recording(table, options, Section{"recording", {}, {}});
}

Finding const* found(Recording const& recording) {
  auto const at = std::find_if(recording.findings.begin(), recording.findings.end(),
                               [](Finding const& one) { return one.kind == FindingKind::reference_constant; });
  return at == recording.findings.end() ? nullptr : &*at;
}

TEST(StopCodes, OfEveryRowAreNoReference) {
  for (double const code : {2.146e9, 16000.0, -1.0, 0.0, std::numeric_limits<double>::quiet_NaN()}) {
    auto const recording = with_code(code, 0.0, 1.0);
    auto const* finding = found(recording);
    ASSERT_NE(finding, nullptr) << code;
    EXPECT_EQ(recording.findings.size(), 1u) << code;
    EXPECT_FALSE(is_fault(*finding));
    EXPECT_EQ(recording.reference.size(), 0);
    EXPECT_THAT(cure_of(*finding), HasSubstr("reference"));
  }
}

TEST(StopCodes, OfAStretchAreMissing) {
  auto const recording = with_code(16000.0, 0.5, 0.7);
  ASSERT_NE(found(recording), nullptr);
  ASSERT_EQ(recording.left_out.size(), 1u);
  EXPECT_NEAR(recording.left_out.front().until_s - recording.left_out.front().from_s, 2.4, 0.05);
  EXPECT_LT(recording.reference.maxCoeff(), 10.0);
  // most rows: what is left is no reference
  EXPECT_EQ(with_code(16000.0, 0.2, 1.0).reference.size(), 0);
}

TEST(StopCodes, AreNotSeenInASoundReference) { EXPECT_EQ(found(with_code(0.0, 0.0, 0.0)), nullptr); }

TEST(RegisterCoding, EveryAdviceCanBeWritten) {
  for (auto const kind : {FindingKind::unsigned_register, FindingKind::sign_magnitude})
    for (int const bits : {8, 10, 12, 14, 16, 24}) {
      Finding finding{kind};
      finding.size = bits;
      finding.detail = "reference";
      auto const cure = cure_of(finding);
      EXPECT_THAT(cure, HasSubstr("{reference = "));
      auto const first = cure.find('"') + 1;
      EXPECT_TRUE(is_encoding(cure.substr(first, cure.find('"', first) - first))) << cure;
    }
  EXPECT_FALSE(is_encoding("unsigned9"));
}

}  // namespace stop_codes_test
}  // namespace torquescope
