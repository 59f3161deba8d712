#pragma once
// [known]: what is known of each recording, as products of its quantities: gravity_moment = "9.80665 * mass_kg * l_m".
//
// Values     a text in quotes (known_product.hpp) or a number; every key may be left out
// Errors     problems are appended (78), at the key: unknown key, unknown or missing quantity, text where a number is
//            needed, a quantity in another unit than the key, a value out of range
// Threads    plain records; functions of their arguments

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "engine/base/options.hpp"
#include "engine/experiment/job/job.hpp"
#include "engine/simulate/rollout/track_known.hpp"

namespace torquescope {

// which keys [known] has
struct KnownKeys {
  bool gravity_moment = false, inertia = false, command_gain = false, command_limit = false, arm_length = false,
       temperature = false;
};

// one recording of a set, before its file is read
struct SetEntry {
  std::string name;            // the file's, without its folder; with it where two have one name
  std::filesystem::path path;  // of the file
  bool is_validation = false;
  std::map<std::string, double> numbers{};     // its quantities
  std::map<std::string, std::string> words{};  // and those that are text
  TrackKnown known{};
  SourcePlace place{};  // where the job or a manifest names it
};

KnownKeys known_keys(Job const& job);

// fills SetEntry::known
void evaluate_known(Job const& job, std::vector<SetEntry>& entries, std::vector<Problem>& problems);

// what `torquescope describe known` prints
std::vector<OptionDescription> describe_known();

}  // namespace torquescope
