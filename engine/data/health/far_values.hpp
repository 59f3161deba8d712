#pragma once
// Values that repeat exactly and lie far from the rows around them: 9999 of a driver without an answer, -1 of a sensor
// that was not ready. They are no data, however many there are.
//
// Outside    met at least four times, and further from all other values than three times their range; -v counts as v.
//            Zero is none: a drive that is off says so
// Inside     in at least three places of up to five rows, half of all its places, away from where the rows around lead
//            and back: five times the steps beside them, and ten times the typical step; a quarter of all places of
//            any value that lie so
// Shapes     values: one per row; NaN is skipped
// Threads    free functions

#include <cstddef>
#include <vector>

namespace torquescope {

struct FarValue {
  double value = 0.0;
  std::vector<std::size_t> rows{};
};

std::vector<FarValue> values_outside(std::vector<double> const& values);
std::vector<FarValue> values_inside(std::vector<double> const& values);

}  // namespace torquescope
