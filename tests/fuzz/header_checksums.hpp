#pragma once
// HDF5's own checksums of the superblock and of object headers (versions 2 and later), made right after a change.
//
// Source     HDF5 File Format Specification 3.0, II.A and IV.A.1.b; Jenkins, lookup3.c, 2006 (hashlittle)

#include <cstdint>
#include <span>

namespace torquescope {

void renew_header_checksums(std::span<std::uint8_t> file);

}  // namespace torquescope
