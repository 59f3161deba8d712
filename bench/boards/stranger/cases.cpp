#include "stranger/cases.hpp"

#include <cmath>
#include <iterator>
#include <numbers>

namespace stranger {

double encoder_bits(int bits) { return std::exp2(bits) / (2 * std::numbers::pi); }

Case usual(std::string name, std::string kind, std::string rig) {
  Case c;
  c.name = std::move(name), c.kind = std::move(kind), c.rig = std::move(rig);
  auto& by = c.instruments;
  if (c.rig == "belt") {
    c.loop = {"cascade", 4000, 5, 0.8, 100, 0};
    by.log_hz = 1000, by.counts_per_unit = 50000;
    c.pipeline = {60, 25, 100};
  } else if (c.rig == "pan") {
    c.loop = {"pid", 2000, 4, 0.8, 80, 0};
    by.log_hz = 500, by.counts_per_unit = encoder_bits(16);
    c.pipeline = {40, 20, 100};
  } else if (c.rig == "arm") {
    c.loop = {"pd", 4000, 4, 0.8, 80, 0};
    by.log_hz = 1000, by.counts_per_unit = encoder_bits(17);
    c.pipeline = {40, 20, 100};
  } else if (c.rig == "gear") {
    c.loop = {"cascade", 8000, 3, 0.8, 100, 0};
    by.log_hz = 1000, by.counts_per_unit = encoder_bits(19);
    c.pipeline = {30, 15, 50};
  } else if (c.rig == "direct") {
    c.loop = {"pd", 8000, 6, 0.8, 150, 0};
    by.log_hz = 2000, by.counts_per_unit = encoder_bits(20);
    c.pipeline = {80, 40, 200};
  } else {
    c.loop = {"stiff_spring", 1000, 5, 0.8, 25, 0};
    by.log_hz = 200, by.counts_per_unit = encoder_bits(12);
    c.pipeline = {20, 10, 50};
  }
  return c;
}

Case single(std::string effect, std::string rig, std::string train, std::string validation, double train_s,
            ConcealedLaw law, Place place) {
  Case c = usual(effect, "single", std::move(rig));
  c.train_motion = std::move(train), c.validation_motion = std::move(validation);
  c.train_s = train_s, c.validation_s = train_s * 0.7;
  law.name = std::move(effect);
  c.laws = {std::move(law)}, c.places = {std::move(place)};
  return c;
}

std::vector<Case> const& all_cases() {
  static std::vector<Case> const cases = [] {
    std::vector<Case> all;
    for (auto part : {clean_cases(), friction_cases(), structure_cases(), further_cases()})
      all.insert(all.end(), std::make_move_iterator(part.begin()), std::make_move_iterator(part.end()));
    return all;
  }();
  return cases;
}

}  // namespace stranger
