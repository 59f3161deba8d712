#include "concealed/drawn_name.hpp"

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <stdexcept>

#include "concealed/decoys.hpp"
#include "concealed/drawable_effects.hpp"
#include "concealed/drawn_rig.hpp"
#include "concealed/sha256.hpp"

namespace concealed {
namespace {

std::vector<std::string> split(std::string const& text, char at) {
  std::vector<std::string> parts(1);
  for (char letter : text) {
    if (letter == at) {
      parts.emplace_back();
    } else {
      parts.back() += letter;
    }
  }
  return parts;
}

template <class Number>
bool read(std::string const& text, Number& value) {
  auto const [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && end == text.data() + text.size();
}

bool holds(std::vector<std::string> const& list, std::string const& word) {
  return std::find(list.begin(), list.end(), word) != list.end();
}

// words that stand before the effects of a name
std::vector<std::string> leading_words(int tier) {
  if (tier == 5) return weak_motions();
  if (tier == 6) return decoys();
  if (tier == 7) return wrong_regimes();
  return {};
}

void check(DrawnName const& name, std::string const& text) {
  auto refuse = [&](char const* why) { throw std::invalid_argument(text + ": " + why); };
  auto const leading = leading_words(name.tier);
  std::size_t const n_effects = name.words.size() - (leading.empty() ? 0 : 1);
  bool const clean = name.tier == 0 || name.tier == 6 || (name.tier == 7 && n_effects == 0);
  if (clean != (name.size == 0.0)) refuse("a size belongs to effects, and effects have a size");
  if (!leading.empty() && !holds(leading, name.words.front())) refuse("unknown first word of this tier");
  std::size_t const wanted[] = {0, 1, 2, 3, 1, 1, 0, clean ? 0u : 1u};
  if (n_effects != wanted[name.tier]) refuse("another number of effects belongs to this tier");
  for (std::size_t i = leading.empty() ? 0 : 1; i < name.words.size(); ++i) {
    bool const outside = name.words[i].starts_with("outside_");
    drawable_effect(name.words[i]);
    if (outside != (name.tier == 4)) refuse("effects outside the catalogue belong to T4, and no others");
  }
}

std::string family_of(DrawableEffect const& effect) {
  Random random(1, "family");
  JointDesign const joint = joint_named(effect.joints.front());
  return effect.draw(random, joint)(effect.usual)(joint).families.front();
}

// of different families, so that each has a name of its own; two effects do not both carry most of the inertia
std::vector<std::string> drawn_set(std::uint64_t seed, std::size_t n) {
  Random random(seed, n == 2 ? "pair" : "triple");
  std::vector<std::string> names, families;
  bool load_is_taken = false;
  while (names.size() < n) {
    auto const& effect = catalogue_effects()[random.index(catalogue_effects().size())];
    std::string const family = family_of(effect);
    bool const takes_load = effect.name == "backlash" || effect.name == "joint_elasticity";
    if (holds(families, family) || (takes_load && load_is_taken)) continue;
    names.push_back(effect.name);
    families.push_back(family);
    load_is_taken = load_is_taken || takes_load;
  }
  return names;
}

// effects that the weak motion hides behind one another
std::vector<std::string> const& hidden_by(std::string const& motion) {
  static std::vector<std::string> const speeds = {"stribeck", "speed_drag", "power_law_viscous", "friction_lag"};
  static std::vector<std::string> const places = {"gravity", "spring", "cable"};
  static std::vector<std::string> const sides = {"asymmetric_viscous", "speed_drag", "power_law_viscous",
                                                 "directional_efficiency"};
  return motion == "one_speed" ? speeds : motion == "narrow" ? places : sides;
}

}  // namespace

std::vector<double> const& effect_sizes() {
  static std::vector<double> const sizes = {0.25, 0.5, 1.0, 2.0, 4.0};
  return sizes;
}

std::vector<std::string> const& weak_motions() {
  static std::vector<std::string> const motions = {"one_speed", "one_direction", "narrow"};
  return motions;
}

std::string DrawnName::text() const {
  std::string out = "T" + std::to_string(tier);
  for (std::size_t i = 0; i < words.size(); ++i) out += (i == 0 ? ":" : "+") + words[i];
  if (size != 0.0) {
    char digits[32];
    std::snprintf(digits, sizeof digits, "%g", size);
    out += std::string(":") + digits;
  }
  return out + ":" + std::to_string(seed);
}

std::string DrawnName::folder() const { return sha256("folder " + text()).substr(0, 12); }

std::uint64_t DrawnName::stream(int again) const {
  std::string const salt = again == 0 ? "" : " again " + std::to_string(again);
  return std::stoull(sha256("stream " + text() + salt).substr(0, 12), nullptr, 16);
}

DrawnName parse_drawn_name(std::string const& text) {
  auto const parts = split(text, ':');
  DrawnName name;
  bool good = parts.size() >= 2 && parts.size() <= 4 && parts[0].size() == 2 && parts[0][0] == 'T' &&
              parts[0][1] >= '0' && parts[0][1] <= '7' && read(parts.back(), name.seed);
  if (good && parts.size() > 2) name.words = split(parts[1], '+');
  if (good && parts.size() == 4) good = read(parts[2], name.size) && name.size > 0.0 && name.size <= 100.0;
  if (!good) throw std::invalid_argument(text + ": write TIER:WORDS:SIZE:SEED, for example T1:stribeck:2:7");
  name.tier = parts[0][1] - '0';
  if (name.tier != 0 && name.words.empty()) throw std::invalid_argument(text + ": words are missing");
  check(name, text);
  return name;
}

DrawnName listed_name(int tier, std::uint64_t index, std::uint64_t suite) {
  std::uint64_t const i = index - 1, shift = suite * seeds_per_suite;
  auto const& effects = catalogue_effects();
  std::vector<double> const large = {1.0, 2.0, 4.0};
  auto nth = [](auto const& list, std::uint64_t place) { return list[place % list.size()]; };
  switch (tier) {
    case 0:
      return {0, {}, 0.0, shift + index};
    case 1: {
      // neighbours differ in effect and size, so that any stretch of the list holds something of all
      std::uint64_t const round = i / effects.size(), n_sizes = effect_sizes().size();
      return {1, {nth(effects, i).name}, nth(effect_sizes(), i % effects.size() + round), shift + 1 + round / n_sizes};
    }
    case 2:
    case 3:
      return {tier, drawn_set(shift + index, static_cast<std::size_t>(tier)), nth(large, i), shift + index};
    case 4:
      return {4, {nth(outside_effects(), i).name}, nth(large, i / outside_effects().size()), shift + index};
    case 5: {
      auto const motion = nth(weak_motions(), i);
      return {5, {motion, nth(hidden_by(motion), i / weak_motions().size())}, 2.0, shift + index};
    }
    case 6:
      return {6, {nth(decoys(), i)}, 0.0, shift + index};
    default:
      break;
  }
  auto const regime = nth(wrong_regimes(), i);
  if (i / wrong_regimes().size() % 2 == 0) return {7, {regime}, 0.0, shift + index};
  Random random(shift + index, "regime");
  return {7, {regime, effects[random.index(effects.size())].name}, 2.0, shift + index};
}

}  // namespace concealed
