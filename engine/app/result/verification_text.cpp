#include "engine/app/result/verification_text.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "engine/app/terminal/plain_text.hpp"

namespace torquescope {

namespace {

using Json = nlohmann::ordered_json;

std::string count_of(std::size_t count, std::string const& what) {
  return fmt::format("{} {}{}", count_text(static_cast<std::int64_t>(count)), what, count == 1 ? "" : "s");
}

Json facts_json(ReadFacts const& facts) {
  return {{"sha256", facts.sha256},
          {"groups", facts.groups},
          {"datasets", facts.datasets},
          {"attributes", facts.attributes},
          {"value_bytes", static_cast<std::uint64_t>(facts.value_bytes)}};
}

}  // namespace

std::string verification_text(Verification const& facts) {
  std::string text = hanging("verified ", fmt::format("{}, {}, format {}, {}", printable(facts.file.string()),
                                                      bytes_text(facts.bytes), facts.format, printable(facts.creator)));
  text +=
      hanging("  content  ",
              fmt::format("{}, {}, {} of values: all read, every checksum holds; sha256 {:.16} as stored",
                          count_of(facts.content.datasets, "dataset"), count_of(facts.content.attributes, "attribute"),
                          bytes_text(static_cast<std::uintmax_t>(facts.content.value_bytes)), facts.content.sha256));
  if (!facts.job_sha256.empty())
    text += hanging("  job      ", fmt::format("its text has the sha256 stored, {:.16}", facts.job_sha256));
  if (facts.provenance.attributes > 0)
    text +=
        hanging("  program  ",
                fmt::format("{} of /provenance: {}", count_of(facts.provenance.attributes, "attribute"),
                            facts.provenance_is_stored ? fmt::format("sha256 {:.16} as stored", facts.provenance.sha256)
                                                       : "their checksums hold; this file stores no sha256 of them"));
  return text;
}

std::string verification_json(Verification const& facts) {
  Json const document = {{"schema", 1},
                         {"file", facts.file.string()},
                         {"bytes", facts.bytes},
                         {"verified", true},
                         {"format", facts.format},
                         {"creator", facts.creator},
                         {"content", facts_json(facts.content)},
                         {"job", {{"sha256", facts.job_sha256}}},
                         {"provenance", facts_json(facts.provenance)},
                         {"provenance_is_stored", facts.provenance_is_stored}};
  return document.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace torquescope
