#include "engine/fit/optim/fuzzy_controller.hpp"

#include <algorithm>
#include <utility>

#include "engine/base/contract.hpp"
#include "engine/base/portable_math.hpp"

namespace torquescope {

namespace {

// name, top of the universe, sigma, means of small, middle, big: seed table 1 under the names of the original paper
FuzzyVariable d11() { return {"d11", 1.0, 0.25, {0.05, 0.5, 0.9}}; }
FuzzyVariable d12(double small_mean) { return {"d12", 1.0, 0.35, {small_mean, 0.5, 0.9}}; }
FuzzyVariable d21() { return {"d21", 2.0, 0.5, {0.1, 0.8, 1.5}}; }
FuzzyVariable d22() { return {"d22", 2.0, 0.5, {0.1, 0.8, 1.5}}; }
FuzzyVariable output_F(double top) { return {"F", top, 0.5, {0.3, 0.6, 0.9}}; }
FuzzyVariable output_CR() { return {"CR", 1.0, 0.35, {0.4, 0.7, 1.0}}; }

// the same table read by the seed's labels, on the ranges of its eq. 9: table 1's D2 is d21, its D3 is d12
FuzzyVariable D1() { return {"D1", 1.0, 0.25, {0.05, 0.5, 0.9}}; }
FuzzyVariable D2() { return {"D2", 1.0, 0.5, {0.1, 0.8, 1.5}}; }
FuzzyVariable D3(double small_mean) { return {"D3", 2.0, 0.35, {small_mean, 0.5, 0.9}}; }
FuzzyVariable D4() { return {"D4", 2.0, 0.5, {0.1, 0.8, 1.5}}; }

// the share of a large change: 0 at rest, towards 1 as c grows
double change_level(double c) {
  // beyond 64, (1 + c) e^-c is below half an ULP of 1; also keeps inf * 0 out
  if (c > 64.0) return 1.0;
  return std::max(0.0, 1.0 - (1.0 + c) * portable_exp(-c));
}

}  // namespace

std::vector<std::string> const& pairing_words() {
  static std::vector<std::string> const words{"original", "literal", "eq9"};
  return words;
}

ChangeLevels change_levels(double PC, double FC) {
  TORQUESCOPE_EXPECT(PC >= 0.0 && FC >= 0.0);
  double const of_parameters = change_level(PC);
  double const of_function = change_level(FC);
  return {of_parameters, of_function, 2.0 * of_parameters, 2.0 * of_function};
}

FuzzyController::Wired FuzzyController::wire_F(FuzzyControllerSettings const& settings) {
  auto const system = [&](FuzzyVariable first, FuzzyVariable second) {
    return MamdaniSystem(std::move(first), std::move(second), output_F(settings.F_universe), settings.defuzzification,
                         settings.centroid_points);
  };
  switch (settings.pairing) {
    case Pairing::literal:
      return {&ChangeLevels::d11, &ChangeLevels::d21, system(D1(), D3(settings.d12_small_mean))};
    case Pairing::eq9:
      return {&ChangeLevels::d11, &ChangeLevels::d12, system(D1(), D2())};
    case Pairing::original:
      break;
  }
  return {&ChangeLevels::d11, &ChangeLevels::d12, system(d11(), d12(settings.d12_small_mean))};
}

FuzzyController::Wired FuzzyController::wire_CR(FuzzyControllerSettings const& settings) {
  auto const system = [&](FuzzyVariable first, FuzzyVariable second) {
    return MamdaniSystem(std::move(first), std::move(second), output_CR(), settings.defuzzification,
                         settings.centroid_points);
  };
  switch (settings.pairing) {
    case Pairing::literal:
      return {&ChangeLevels::d12, &ChangeLevels::d22, system(D2(), D4())};
    case Pairing::eq9:
      return {&ChangeLevels::d21, &ChangeLevels::d22, system(D3(settings.d12_small_mean), D4())};
    case Pairing::original:
      break;
  }
  return {&ChangeLevels::d21, &ChangeLevels::d22, system(d21(), d22())};
}

FuzzyController::FuzzyController(FuzzyControllerSettings const& settings)
    : F_(wire_F(settings)), CR_(wire_CR(settings)) {}

ControlParameters FuzzyController::operator()(double PC, double FC) const {
  auto const levels = change_levels(PC, FC);
  return {F_(levels), CR_(levels)};
}

}  // namespace torquescope
