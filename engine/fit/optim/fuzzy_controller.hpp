#pragma once
// The two fuzzy controllers of FADE: from the movement of one generation to F and CR of the next.
//
// Equation   m(c) = 1 - (1 + c) e^-c;   d11 = m(PC), d12 = m(FC), d21 = 2 m(PC), d22 = 2 m(FC)          (seed eq. 9)
// Pairing    which two levels each controller sees, because the seed contradicts itself (its eq. 9 and tables 1, 2 swap
//            D2 and D3):
//   original   F from (d11, d12), CR from (d21, d22), every level with the sets made for its range (Liu, Lampinen)
//   literal    tables 1 and 2 with the values of eq. 9 under the same labels: F from (D1, D3), CR from (D2, D4);
//              F then sees only PC, CR only FC
//   eq9        pairs as original, but each label D1 .. D4 of eq. 9 with the sets table 1 prints for it:
//              F from (D1, D2), CR from (D3, D4)
// Range      PC, FC >= 0, inf included. The centroid reaches only F .443 to .612 of [0, 1] or .624 to .924 of [0, 2],
//            and CR .450 to .687
// Threads    const object, any number of threads
// Source     seed section 3.5, tables 1 and 2; Liu, Lampinen: A fuzzy adaptive differential evolution algorithm, Soft
//            Computing 9 (2005) 448-462

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "engine/fit/optim/mamdani.hpp"

namespace torquescope {

enum class Pairing { original, literal, eq9 };

// in the order of the enum
std::vector<std::string> const& pairing_words();

struct FuzzyControllerSettings {
  Pairing pairing = Pairing::original;
  double F_universe = 2.0;      // F in [0, F_universe]; the seed does not say; 1 or 2
  double d12_small_mean = 0.1;  // seed .1, an implementation at large (Beprados) .01
  Defuzzification defuzzification = Defuzzification::centroid;
  std::size_t centroid_points = 1001;
};

// the four names of the original paper; equal to D1, D2, D3, D4 of the seed's eq. 9
struct ChangeLevels {
  double d11, d12, d21, d22;
};

ChangeLevels change_levels(double PC, double FC);

struct ControlParameters {
  double F, CR;
};

class FuzzyController {
 public:
  explicit FuzzyController(FuzzyControllerSettings const& settings);

  ControlParameters operator()(double PC, double FC) const;

  // the two levels each system reads: a point on its decision surface
  std::array<double, 2> F_inputs(double PC, double FC) const { return F_.inputs(change_levels(PC, FC)); }
  std::array<double, 2> CR_inputs(double PC, double FC) const { return CR_.inputs(change_levels(PC, FC)); }

  MamdaniSystem const& F_system() const { return F_.system; }
  MamdaniSystem const& CR_system() const { return CR_.system; }

 private:
  // one Mamdani system with the levels its two inputs read
  struct Wired {
    double ChangeLevels::*first;
    double ChangeLevels::*second;
    MamdaniSystem system;
    std::array<double, 2> inputs(ChangeLevels const& levels) const { return {levels.*first, levels.*second}; }
    double operator()(ChangeLevels const& levels) const { return system(levels.*first, levels.*second); }
  };
  static Wired wire_F(FuzzyControllerSettings const& settings);
  static Wired wire_CR(FuzzyControllerSettings const& settings);

  Wired F_;
  Wired CR_;
};

}  // namespace torquescope
