#include "engine/store/verification.hpp"

#include <fmt/format.h>

#include <system_error>

#include "engine/base/error.hpp"
#include "engine/store/result_reader.hpp"

namespace torquescope {
namespace {

Error contradicts(std::filesystem::path const& file, std::string const& object, std::string const& reason) {
  return Error(Problem{.code = ExitCode::bad_data,
                       .what = fmt::format("{} is damaged in {}: {}", file.string(), object, reason),
                       .help = "delete it and run the job again: the same command makes the same file"});
}

// the text that the run read, as the file keeps it
std::string job_digest(ResultReader const& reader) {
  auto const texts = reader.texts("/job/text");
  if (texts.size() != 1)
    throw contradicts(reader.name(), "/job/text", fmt::format("{} texts instead of one", texts.size()));
  auto found = sha256_hex(texts[0]);
  if (found != reader.attribute<std::string>("/job", "sha256"))
    throw contradicts(reader.name(), "/job/text", "the job text does not match its sha256");
  return found;
}

}  // namespace

Verification verify_everything(std::filesystem::path const& file) {
  ResultReader const reader(file);
  Verification facts{.file = file,
                     .format = reader.attribute<std::int64_t>("/", "format"),
                     .creator = reader.attribute<std::string>("/", "creator")};
  std::error_code unknown;
  facts.bytes = std::filesystem::file_size(file, unknown);
  facts.content = reader.verified_content();
  facts.provenance = reader.read_everything(FilePart::provenance);
  auto const stored = reader.find_attribute<std::string>("/", provenance_digest_key);
  facts.provenance_is_stored = stored.has_value();
  if (stored && *stored != facts.provenance.sha256)
    throw contradicts(file, provenance_path, "what it says of the program does not match its sha256");
  reader.expect_seal();
  bool const is_segment = reader.exists("/segment");  // it names its job, but does not hold it
  if (!is_segment) facts.job_sha256 = job_digest(reader);
  return facts;
}

}  // namespace torquescope
