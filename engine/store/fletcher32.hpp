#pragma once
// The checksum of HDF5's fletcher32 filter, several times as fast as HDF5's own.
//
// Equation   16-bit words w_0 .. w_(n-1), high byte first; s1 = sum of w_i, s2 = sum of (n - i) w_i, both modulo 65535;
//            result s2 * 65536 + s1. A residue of 0 is 65535 unless all words are 0
//            (then s2 is 0 as well); an odd number of bytes ends with a byte 0 more
// Threads    any
// Source     H5checksum.c of HDF5 1.10 (H5_checksum_fletcher32)

#include <cstddef>
#include <cstdint>
#include <span>

namespace torquescope {

std::uint32_t fletcher32(std::span<std::byte const> bytes);

}  // namespace torquescope
