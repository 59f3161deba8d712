#pragma once
// The digest of a file that is there: every attribute and every value is read, object by object (content_digest.hpp).
//
// Errors     h5::Failure with the path of the object that cannot be read (a checksum that does not match)
// Hostile    a file in which two names lead to one object (so paths could be endless), or that claims more values in
//            all than its bytes can hold, is refused
// Memory     4 MiB of values, or one row of a dataset, if more
// Threads    one at a time

#include <cstddef>
#include <string>

#include "engine/store/content_digest.hpp"

namespace torquescope {

// what was read for a digest
struct ReadFacts {
  std::string sha256{};
  std::size_t groups = 0, datasets = 0, attributes = 0;
  double value_bytes = 0.0;  // of the datasets, unpacked
};

// every attribute and every value of a part of the file is read
ReadFacts read_everything(h5::Handle const& file, FilePart part);

}  // namespace torquescope
