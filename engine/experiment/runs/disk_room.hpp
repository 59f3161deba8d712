#pragma once
// Is there room for what a job will write? Asked before hours are spent on it.
//
// Counts     numbers of the histories and of the samples, 8 bytes each, and a little for names; a tenth of it with gzip
//            (histories shrink to a fifth, but a result that would fit must never be refused)
// Errors     74 with path, bytes needed and bytes free; where the file system does not say, there is room
// Threads    free functions

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "engine/experiment/experiment_parts.hpp"
#include "engine/experiment/runs/identify_options.hpp"

namespace torquescope {

// of the result file of the whole job
std::uintmax_t result_bytes(Experiment::Parts const& parts);

// of the segments of so many runs of every population method, at most: runs may end early
std::uintmax_t segment_bytes(Experiment::Parts const& parts, std::size_t runs);

// of the result file of a diagnosis: its samples, and the traces of torque of the recordings that it draws
std::uintmax_t diagnosis_bytes(Experiment::Parts const& parts);

// what the caller wants to write, and what it would do about too little room
struct RoomWish {
  std::filesystem::path const& output;
  bool allow_full_disk = false;
  std::function<void(std::string const& topic, std::string const& text)> const& tell;
  std::string smaller;  // what else makes the result smaller
};

// throws when fewer bytes are free beside the result; or tells it as a warning, when that is allowed
void check_room(RoomWish const& wish, std::uintmax_t needed, std::filesystem::path const& file);
void check_room(IdentifyOptions const& options, std::uintmax_t needed, std::filesystem::path const& file);

}  // namespace torquescope
