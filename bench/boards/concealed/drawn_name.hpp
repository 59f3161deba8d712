#pragma once
// Names of drawn cases: everything about such a case follows from its name.
//
// Grammar    TIER:WORDS:SIZE:SEED, WORDS joined by +, for example
//              T0:17                          clean
//              T1:stribeck:0.5:3              one effect at SNR_eff 0.5
//              T2:stribeck+cable:2:8          two effects, each at SNR_eff 2 when alone;  T3 likewise three
//              T4:outside_sloshing:2:5        physics the catalogue does not hold
//              T5:one_speed+stribeck:2:9      weak motion; a rich one of the rig would show the effect at SNR_eff 2
//              T6:filter:4                    a decoy of measurement, no physics concealed
//              T7:noise:6                     a rig out of the ordinary, clean
//              T7:gains+spring:2:7            the same with one effect
// Folder     twelve hexadecimal digits that tell nothing; the truth file holds the name
// Errors     std::invalid_argument with what to write instead

#include <cstdint>
#include <string>
#include <vector>

namespace concealed {

struct DrawnName {
  int tier = 0;
  std::vector<std::string> words;
  double size = 0.0;  // SNR_eff of each effect; 0: nothing concealed
  std::uint64_t seed = 0;

  std::string text() const;
  std::string folder() const;
  // seed of everything random about the case; `again`: of the same case drawn anew for the first, second, ... time
  std::uint64_t stream(int again = 0) const;
};

DrawnName parse_drawn_name(std::string const& text);

// number `index` of its tier, from 1 to seeds_per_suite - 1; T1 goes through all effects and sizes before the seed
// changes. Another suite has other seeds throughout: what was mended while looking at one is tested on one nobody has
// looked at
inline constexpr std::uint64_t seeds_per_suite = 100000;
DrawnName listed_name(int tier, std::uint64_t index, std::uint64_t suite = 0);

std::vector<double> const& effect_sizes();
std::vector<std::string> const& weak_motions();

}  // namespace concealed
