#include "engine/workflows/drafts/name_quantity.hpp"

#include <algorithm>
#include <limits>

namespace torquescope {
namespace {

// a meaning that letters usually have; it is believed between least and most
struct UsualMeaning {
  std::vector<std::string> prefixes, units;  // units: "" where none is written
  char const* quantity;
  double least, most;
};

std::vector<UsualMeaning> const& usual_meanings() {
  constexpr double unlimited = std::numeric_limits<double>::infinity(), tiny = std::numeric_limits<double>::min();
  static std::vector<std::string> const mass{"m", "M", "mass", "Mass", "load", "payload", ""},
      length{"l", "L", "len", "length", "Length", "arm", ""},
      supply{"v", "V", "vin", "Vin", "VIN", "u", "U", "supply", "voltage", ""},
      temperature{"T", "temp", "Temp", "temperature", ""};
  // without a unit the letters have to be there
  auto const lettered = [](std::vector<std::string> prefixes) {
    prefixes.pop_back();
    return prefixes;
  };
  static std::vector<UsualMeaning> const table{
      {mass, {"kg", "Kg", "KG"}, "mass_kg", 0.0, unlimited},
      {mass, {"g"}, "mass_g", 0.0, unlimited},
      {{"m", "M", "mass", "Mass"}, {""}, "mass_kg", 0.0, 50.0},
      {length, {"mm"}, "length_mm", tiny, unlimited},
      {length, {"cm"}, "length_cm", tiny, unlimited},
      {length, {"m"}, "length_m", tiny, unlimited},
      {lettered(length), {""}, "length_m", tiny, 3.0},
      {lettered(length), {""}, "length_mm", 20.0, unlimited},
      {{"kp", "Kp", "KP"}, {""}, "kp", 0.0, unlimited},
      {{"kd", "Kd", "KD"}, {""}, "kd", 0.0, unlimited},
      {{"ki", "Ki", "KI"}, {""}, "ki", 0.0, unlimited},
      {supply, {"V", "v"}, "supply_v", 1.0, 1000.0},
      {lettered(supply), {""}, "supply_v", 3.0, 100.0},
      {temperature, {"C", "c", "degC", "degc"}, "temperature_c", -273.15, unlimited},
      {lettered(temperature), {""}, "temperature_c", -60.0, 200.0},
  };
  return table;
}

bool contains(std::vector<std::string> const& list, std::string const& word) {
  return std::find(list.begin(), list.end(), word) != list.end();
}

}  // namespace

std::string quantity_of_number(std::string const& prefix, std::string const& unit, std::vector<double> const& values) {
  for (auto const& meaning : usual_meanings()) {
    if (!contains(meaning.prefixes, prefix) || !contains(meaning.units, unit)) continue;
    bool const is_plausible = std::all_of(
        values.begin(), values.end(), [&](double value) { return value >= meaning.least && value <= meaning.most; });
    if (is_plausible) return meaning.quantity;
  }
  return {};
}

}  // namespace torquescope
