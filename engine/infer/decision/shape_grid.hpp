#pragma once
// The points at which an effect's shape is tried.
//
// Points     waves (orders, frequencies): 0.7 of the resolution of range or duration, most_waves at most; instants and
//            places: 24; else 10 for one parameter, 6 each for two, 4 each for three; logarithmic ones a factor of 2.5
//            apart (3 to 10). Of four, one that is linear or absent at its lower bound stays at that bound
// Resonance  a fifth from one to the next, four points of each other parameter
// Lattice    of three or more parameters every other point, like the white fields of a chessboard: half as many. The
//            furthest shape is one step from the next point, not 0.87 (three parameters; as far of four)
// Units      SI of the parameter; the unit scale goes from 0 to 1 over the bounds (logarithmic where the parameter is)
// Threads    free functions
// Source     lattices Dn and their covering radii: Conway, Sloane 1999, doi:10.1007/978-1-4757-6568-7, chapter 4

#include <cstddef>
#include <optional>
#include <vector>

#include "engine/effects/effect.hpp"
#include "engine/fit/optim/objective.hpp"

namespace torquescope {

inline constexpr std::size_t most_waves = 4096;

struct ShapeGrid {
  std::vector<ParameterRange> ranges{};
  std::vector<std::vector<double>> axes{};         // per shape parameter
  std::vector<std::vector<std::size_t>> places{};  // per point: where it is on each axis

  std::size_t size() const { return places.size(); }  // 1 for an effect without shape
  std::vector<double> point(std::size_t index) const;
  std::vector<double> to_unit_scale(std::vector<double> const& shape) const;
  std::vector<double> from_unit_scale(std::vector<double> const& unit) const;
  // half the way to the next point, in the unit scale; 0 where there is one value
  std::vector<double> half_steps() const;
};

ShapeGrid shape_grid(Effect const& effect, JointScales const& scales);
// of these axes; `ranges`: one each
enum class GridPoints { all, lattice };
ShapeGrid grid_over(std::vector<ParameterRange> ranges, std::vector<std::vector<double>> axes, GridPoints points);

// unit scale <-> parameter
double to_unit(ParameterRange const& range, double value);
double from_unit(ParameterRange const& range, double unit);

// of a difference quotient at `value`, within the range; 0: the range has one value
double shape_step(ParameterRange const& range, double value);

}  // namespace torquescope
