#pragma once
// Is this file what the program wrote? Everything in it is read and compared with what it says about itself.
//
// Checked    what ResultReader checks at opening, and that the seal is there where it is promised; the checksum of
//            every object header and of every chunk; SHA-256 of the content; of the job text; of /provenance, which is
//            one of its own because another build writes another. Files of earlier versions have none: there it is read
//            (its checksums hold) and its digest is said
// Errors     Error 66 when there is no such file; 65 with the path of what is damaged inside it
// Threads    as ResultReader: one at a time
// Cost       as reading the whole file once

#include <cstdint>
#include <filesystem>
#include <string>

#include "engine/store/file_digest.hpp"

namespace torquescope {

struct Verification {
  std::filesystem::path file{};
  std::uintmax_t bytes = 0;
  std::int64_t format = 0;
  std::string creator{};
  ReadFacts content{};  // its digest is the stored one
  ReadFacts provenance{};
  bool provenance_is_stored = false;  // its digest, and it was compared
  std::string job_sha256{};           // "" for a segment, which does not hold its job
};

Verification verify_everything(std::filesystem::path const& file);

}  // namespace torquescope
