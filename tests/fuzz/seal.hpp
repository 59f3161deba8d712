#pragma once
// The seal at the end of our files (engine/store/RESULT_FORMAT.md, "Seal"), made right after a change.

#include <cstdint>
#include <span>

namespace torquescope {

// of a file that still ends with one; nothing otherwise
void renew_seal(std::span<std::uint8_t> file);

}  // namespace torquescope
