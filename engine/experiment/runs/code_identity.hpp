#pragma once
// Which code computes here: what must be equal for two processes to write parts of one result.
//
// Bits       threads, shards and the vector target change none (kernels/dispatch.hpp), so none of them is in the
//            identity; sources, compiler, kind of build and version are
// Threads    free functions

#include <string>

namespace torquescope {

// of every source file that takes part in a number (not of app: words change no bit)
char const* sources_sha256();
// "ce69a77f0a12", "-dirty" behind it when files were changed; "" where there was no git. For people
char const* source_commit();

std::string numerics_sha256();

}  // namespace torquescope
