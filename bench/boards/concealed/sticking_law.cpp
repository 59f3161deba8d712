#include "concealed/sticking_law.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>

namespace concealed {
namespace {

constexpr double karnopp_speed = 1e-3;
constexpr double least_length = 1e-5;  // shorter bristles ask for steps below a microsecond

std::array<std::pair<char const*, double>, 3> constexpr creeps{
    {{"creep_0.2", 0.2e-3}, {"creep_2", 2e-3}, {"creep_20", 20e-3}}};

}  // namespace

StickingLaw sticking_named(std::string const& name, double encoder_step) {
  if (name == "coulomb") return {};
  if (name == "lugre") return {Sticking::bristle, 0.0, std::max(least_length, encoder_step)};
  if (name == "karnopp") return {Sticking::band, karnopp_speed, 0.0};
  for (auto const& [creep, speed] : creeps)
    if (name == creep) return {Sticking::creep, speed, 0.0};
  throw std::invalid_argument("no sticking law named " + name);
}

std::vector<std::string> const& sticking_names() {
  static std::vector<std::string> const names = {"coulomb", "creep_0.2", "creep_2", "creep_20", "lugre", "karnopp"};
  return names;
}

}  // namespace concealed
