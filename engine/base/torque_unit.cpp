#include "engine/base/torque_unit.hpp"

#include <array>
#include <utility>

namespace torquescope {

std::string in_torque_unit(std::string const& si, std::string const& torque) {
  if (torque.empty() || torque == "N m" || torque == "N") return si;
  if (si == "(N m)2" || si == "N2") return torque + "2";
  // longest first: kg m of a first moment is a torque per acceleration along m
  constexpr std::array<std::pair<char const*, char const*>, 6> parts{
      {{"kg m2", " s2/rad"}, {"kg m^2", " s2/rad"}, {"kg m", " s2/m"}, {"kg", " s2/m"}, {"N m", ""}, {"N", ""}}};
  for (auto const& [front, instead] : parts) {
    std::string const word = front;
    bool const ends =
        si.size() == word.size() || (si.starts_with(word) && (si[word.size()] == ' ' || si[word.size()] == '/'));
    if (si.starts_with(word) && ends) return torque + instead + si.substr(word.size());
  }
  return si;
}

}  // namespace torquescope
