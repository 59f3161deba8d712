#pragma once
// The bytes of a regular file, read once. A folder, FIFO or device is refused before anything could hang on it.
//
// Errors     Error 66 when it is not there, not readable or not a regular file (with the closest name beside it),
//            65 when it is larger than the limit, 74 when reading fails

#include <cstdint>
#include <filesystem>
#include <string>

namespace torquescope {

// one recording; more would not fit the fit either
inline constexpr std::uint64_t largest_file_bytes = std::uint64_t{2} << 30;
// numbers in one recording, all columns together: 2 GiB
inline constexpr std::uint64_t most_table_values = std::uint64_t{1} << 28;

std::string read_whole_file(std::filesystem::path const& path, std::uint64_t most_bytes = largest_file_bytes);
// fewer when the file is shorter
std::string read_first_bytes(std::filesystem::path const& path, std::size_t count);
std::string read_last_bytes(std::filesystem::path const& path, std::size_t count);

}  // namespace torquescope
