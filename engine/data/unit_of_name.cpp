#include "engine/data/unit_of_name.hpp"

#include <algorithm>
#include <cctype>
#include <numbers>
#include <vector>

#include "engine/data/repeated_names.hpp"

namespace torquescope {
namespace {

constexpr double turn = 2.0 * std::numbers::pi;

struct KnownUnit {
  std::vector<std::string> spellings;
  NamedUnit unit;
};

std::vector<KnownUnit> const& known_units() {
  using enum Quantity;
  static std::vector<KnownUnit> const units{
      {{"s", "sec", "secs", "second", "seconds", "sek", "sekunden", "秒"}, {"s", time, 1.0}},
      {{"ms", "msec", "msecs", "millis", "millisecond", "milliseconds", "ミリ秒", "毫秒"}, {"ms", time, 1e-3}},
      {{"us", "usec", "usecs", "micros", "microsecond", "microseconds", "\xc2\xb5s", "\xce\xbcs"}, {"us", time, 1e-6}},
      {{"ns", "nsec", "nsecs", "nanos", "nanosec", "nanosecond", "nanoseconds"}, {"ns", time, 1e-9}},
      {{"rad", "radian", "radians"}, {"rad", angle, 1.0}},
      {{"mrad"}, {"mrad", angle, 1e-3}},
      {{"deg", "degree", "degrees", "\xc2\xb0", "grad", "grados", "degres", "degrés", "gradi", "度"},
       {"deg", angle, turn / 360.0}},
      {{"mdeg", "millideg"}, {"mdeg", angle, turn / 360e3}},
      {{"rev", "revs", "turn", "turns", "rotations"}, {"turns", angle, turn}},
      {{"m", "meter", "metre"}, {"m", length, 1.0}},
      {{"mm"}, {"mm", length, 1e-3}},
      {{"um", "\xc2\xb5m"}, {"um", length, 1e-6}},
      {{"cm"}, {"cm", length, 1e-2}},
      {{"rad/s", "radps", "rads", "rad_s", "rad·s⁻¹", "rad s^-1"}, {"rad/s", angular_speed, 1.0}},
      {{"deg/s", "degps", "dps", "deg_s", "\xc2\xb0/s"}, {"deg/s", angular_speed, turn / 360.0}},
      {{"rpm", "1/min", "min-1", "u/min", "r/min", "rev/min", "tr/min", "giri/min", "min^-1", "min⁻¹", "upm"},
       {"rpm", angular_speed, turn / 60.0}},
      {{"rps", "turns/s", "rev/s"}, {"turns/s", angular_speed, turn}},
      {{"m/s", "mps", "m_s"}, {"m/s", speed, 1.0}},
      {{"mm/s", "mmps"}, {"mm/s", speed, 1e-3}},
      {{"rad/s2", "rad/s^2", "radps2", "rad_s2", "m/s2", "m/s^2", "mps2"}, {"per s2", acceleration, 1.0}},
      {{"nm", "n m", "n*m", "n.m", "n·m", "n⋅m", "n・m", "newtonmeter"}, {"N m", torque, 1.0}},
      {{"mnm", "nmm", "mn·m", "mn.m", "mn*m", "mn m"}, {"mN m", torque, 1e-3}},
      {{"knm"}, {"kN m", torque, 1e3}},
      {{"ncm"}, {"N cm", torque, 1e-2}},
      {{"n", "newton"}, {"N", force, 1.0}},
      {{"kn"}, {"kN", force, 1e3}},
      {{"a", "amp", "amps", "ampere", "arms"}, {"A", current, 1.0}},
      {{"ma", "milliamp"}, {"mA", current, 1e-3}},
      {{"v", "volt", "volts"}, {"V", voltage, 1.0}},
      {{"mv"}, {"mV", voltage, 1e-3}},
      {{"permille", "promille", "per mille", "\xe2\x80\xb0", "permil"}, {"per mille", ratio, 1e-3}},
      {{"percent", "pct", "%", "prc", "prozent"}, {"percent", ratio, 1e-2}},
      {{"cnt", "cnts", "count", "counts", "tick", "ticks", "cts", "inc", "incs", "incr", "inkr", "increments", "raw",
        "lsb", "enc", "pulses"},
       {"counts", counts, 1.0}},
  };
  return units;
}

std::string lowered(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  auto const blank = [](unsigned char c) { return std::isspace(c) != 0; };
  text.erase(text.begin(), std::find_if_not(text.begin(), text.end(), blank));
  text.erase(std::find_if_not(text.rbegin(), text.rend(), blank).base(), text.end());
  return text;
}

// "t [ms]" -> "ms"; "" without brackets at the end
std::string in_brackets(std::string const& name) {
  if (name.empty() || (name.back() != ']' && name.back() != ')')) return {};
  auto const open = name.find_last_of(name.back() == ']' ? '[' : '(');
  return open == std::string::npos ? std::string() : name.substr(open + 1, name.size() - open - 2);
}

}  // namespace

std::optional<NamedUnit> known_unit(std::string const& word) {
  for (auto const& candidate : known_units())
    for (auto const& spelling : candidate.spellings)
      if (word == spelling) return candidate.unit;
  return {};
}

bool tells_si(NamedUnit const& unit) {
  using enum Quantity;
  return unit.quantity != current && unit.quantity != voltage && unit.quantity != ratio && unit.quantity != counts;
}

std::optional<NamedUnit> unit_of_name(std::string const& column, std::string const& units) {
  std::string const written = lowered(units);
  if (!written.empty()) {
    std::string const inner = in_brackets(written);
    return known_unit(inner.empty() ? written : lowered(inner));
  }
  std::string const plain = without_repeat(column);
  std::string const name = lowered(plain.substr(plain.find_last_of('/') + 1));
  if (auto const bracketed = in_brackets(name); !bracketed.empty()) return known_unit(lowered(bracketed));
  // words of one letter after the name ("i_A", "u_V", "t_s", "F_N") count, "joint.v" does not
  auto const last = name.find_last_of("_ ");
  if (last == std::string::npos) return {};
  auto const before = name.find_last_of("_ ", last - 1);
  if (last > 0 && before != std::string::npos)
    if (auto two = known_unit(name.substr(before + 1)); two) return two;  // "dq_rad_s", "torque_per mille"
  return known_unit(name.substr(last + 1));
}

}  // namespace torquescope
