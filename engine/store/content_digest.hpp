#pragma once
// SHA-256 of what a result file says, whatever its bytes are: the same for gzip and plain storage, any number of
// threads.
//
// Covers     every object in the order of its path: kind, attributes in the order of their names (type, shape, values)
// and,
//            of a dataset, element type, shape and values. Texts count without padding.
// Errors     h5::Failure with the path of the object that cannot be read (a checksum that does not match)
// Memory     8 MiB of values at a time (or one row of a dataset, if that is more)

#include <string>

#include "engine/store/h5.hpp"

namespace torquescope {

// root attributes that say something about the file rather than about its content
inline constexpr char complete_key[] = "complete";
inline constexpr char content_digest_key[] = "content_sha256";

// everything but /provenance (host, times, threads) and the two attributes above
std::string content_digest(h5::Handle const& file);

}  // namespace torquescope
