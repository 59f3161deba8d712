#pragma once
// Writes how, when and where a result was made: /provenance (RESULT_FORMAT.md), which no digest covers.
//
// Errors     those of ResultWriter

#include <string>

#include "engine/base/parallel.hpp"
#include "engine/store/result_writer.hpp"

namespace torquescope {

std::string utc_now();  // "2026-03-01T12:00:00Z"

// started: utc_now() when the work began; it ends now
void write_provenance(ResultWriter& writer, ThreadChoice const& threads, std::string const& started, double seconds);

}  // namespace torquescope
