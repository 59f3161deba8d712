#pragma once
// Whether a command has done its work already: the same job on the same recordings is not computed twice.
//
// Errors     73 when something else stands under the output's name

#include <filesystem>
#include <string>

namespace torquescope {

enum class ResultKind { runs, diagnosis };

// whether this very job, on these very recordings, has already made the output, and of this kind. continued: a result
// that may stand there although another job made it: the new one goes on from it, and replaces it once whole
bool already_complete(std::filesystem::path const& output, std::string const& inputs_sha256, ResultKind kind,
                      std::filesystem::path const& continued = {});

}  // namespace torquescope
