// A file whose parts are each whole but contradict one another is not verified.

#include "engine/store/verification.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/base/error.hpp"
#include "engine/store/result_reader.hpp"
#include "engine/store/result_writer.hpp"
#include "support/temporary_folder.hpp"
#include "unit/store/example_result.hpp"

namespace torquescope {
namespace verification_test {

constexpr char job_text[] = "[experiment]\nname = \"small\"\n";

std::string write_with_job_digest(std::filesystem::path const& name, std::string const& digest, double threads = 1.0) {
  ResultWriter writer(name, {});
  writer.attribute("/job", "sha256", digest);
  writer.texts("/job/text", std::vector<std::string>{job_text}, {"1", "job file, verbatim"});
  writer.numbers("/data/train/torque", {example::samples}, example::torque(), {"N m", "torque"});
  writer.attribute("/provenance", "threads", threads);
  return writer.finish();
}

TEST(Verification, SaysWhatItHasRead) {
  test::TemporaryFolder const folder;
  auto const written = write_with_job_digest(folder / "R.h5", sha256_hex(job_text));
  auto const facts = verify_everything(folder / "R.h5");
  EXPECT_EQ(facts.content.sha256, written);
  EXPECT_EQ(facts.job_sha256, sha256_hex(job_text));
  EXPECT_EQ(facts.content.datasets, 2u);
  EXPECT_EQ(facts.content.groups, 4u);  // /, /job, /data, /data/train
  EXPECT_EQ(facts.content.value_bytes, example::samples * sizeof(double) + sizeof(job_text) - 1);
  EXPECT_EQ(facts.provenance.attributes, 1u);
}

TEST(Verification, JobTextMustHaveItsOwnDigest) {
  test::TemporaryFolder const folder;
  write_with_job_digest(folder / "R.h5", sha256_hex("another job"));
  try {
    verify_everything(folder / "R.h5");
    FAIL() << "verified";
  } catch (Error const& error) {
    EXPECT_EQ(error.code(), ExitCode::bad_data);
    EXPECT_THAT(error.what(), testing::HasSubstr("in /job/text: the job text does not match its sha256"));
  }
}

TEST(Verification, ProvenanceHasADigestApart) {
  test::TemporaryFolder const folder;
  write_with_job_digest(folder / "A.h5", sha256_hex(job_text), 1.0);
  write_with_job_digest(folder / "B.h5", sha256_hex(job_text), 2.0);
  auto const a = verify_everything(folder / "A.h5"), b = verify_everything(folder / "B.h5");
  EXPECT_EQ(a.content.sha256, b.content.sha256);
  EXPECT_NE(a.provenance.sha256, b.provenance.sha256);
  EXPECT_TRUE(a.provenance_is_stored);
  EXPECT_EQ(ResultReader(folder / "A.h5").attribute<std::string>("/", "provenance_sha256"), a.provenance.sha256);
}

}  // namespace verification_test
}  // namespace torquescope
