#pragma once
// How far packed bytes may grow: what was measured packs to a half, a joint at rest to a fiftieth.
//
// Errors     Error 65 beyond most_times the packed size, where that is more than largest_unasked (a zip bomb)

#include <cstdint>
#include <string>

namespace torquescope {

inline constexpr std::uint64_t largest_unasked = std::uint64_t{64} << 20;
inline constexpr std::uint64_t most_times = 200;

void refuse_bomb(std::uint64_t unpacked, std::uint64_t packed, std::string const& path);

}  // namespace torquescope
