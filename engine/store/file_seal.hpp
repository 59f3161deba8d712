#pragma once
// The last bytes of every file of ours: whose it is, and a SHA-256 of all its bytes but the values.
//
// Why        HDF5 1.10 checks its own structures only where it passes, and crashes on some that are damaged: with the
//            seal they are compared before HDF5 sees them. Chunks of values have checksums of their own (fletcher32)
// Layout     behind the end of the HDF5 file, where HDF5 does not look: RESULT_FORMAT.md, "Seal"
// Identity   of the job that wrote it: a file is only deleted when it is that of the job that deletes it
// Errors     writing: those of TempFile. Reading: 74 when the disk fails
// Threads    free functions

#include <cstdint>
#include <optional>
#include <string>

#include "engine/base/digest.hpp"
#include "engine/store/byte_ranges.hpp"
#include "engine/store/read_file.hpp"
#include "engine/store/temp_file.hpp"

namespace torquescope {

// of a job, from the SHA-256 of its text and recordings; of "" it is the identity of nobody. What a job keeps on its
// way (segments, replicates) has another one than its result, which nobody ever removes
enum class Keeps { result, work };
Sha256 job_identity(std::string const& inputs_sha256, Keeps keeps);

// appends the seal to what was written; values: where the chunks of values lie
void seal_file(TempFile& file, ByteRanges const& values, Sha256 const& job);

enum class Seal { whole, absent, broken };
Seal check_seal(ReadFile const& file);

// the identity in the seal of an open file that begins and ends as ours do; nothing when it does not
std::optional<Sha256> sealed_identity(int descriptor);

}  // namespace torquescope
