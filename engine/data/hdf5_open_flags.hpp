#pragma once
// The mark in an HDF5 file that says it is open for writing: it stays when the program is killed, and the library then
// refuses a file whose contents are whole.
//
// Place      byte 11 of a superblock of version 2 or 3, which ends in a checksum of its own
// Threads    function of its argument
// Source     HDF5 File Format Specification 3.0, section II.A; checksum: Jenkins' lookup3

#include <string>

namespace torquescope {

// takes the mark away; false: there was none, or the superblock is damaged
bool clear_open_flags(std::string& file);

}  // namespace torquescope
