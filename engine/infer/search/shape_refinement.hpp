#pragma once
// The shape of one effect that explains most of the mismatch: a population search in the shapes, the linear parameters
// solved inside (variable projection), then Levenberg-Marquardt from the best.
//
// Search     any optimiser of the registry in a box of the grid round the best grid points; over all bounds for parts
//            that ring, where the grid is too coarse (ShapeSearch::everywhere)
// Polish     steps of the mismatch on [columns | tangents of the shapes], damped, inside the bounds of the effect
// Evaluation one evaluation = columns of the effect at one shape through the filter
// Threads    spreads the members of a generation over `threads`; same bits for any number
// Source     Golub, Pereyra 1973, doi:10.1137/0710036; Levenberg 1944; Marquardt 1963, doi:10.1137/0111030

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "engine/fit/optim/optimiser.hpp"
#include "engine/infer/search/effect_scan.hpp"

namespace torquescope {

// of what another one explains: what explains so much has not lost to it
inline constexpr double nearly_as_good = 0.9;

using MakeShapeSearch = std::function<std::unique_ptr<Optimiser>(Bounds const&, RandomKey)>;

struct ShapeSearch {
  MakeShapeSearch make{};
  int generations = 8;
  std::uint64_t seed = 0;
  bool everywhere = false;  // within the bounds, and not next to the grid's best point
};

// the registry's optimiser of that name; members: of its population, for few dimensions
ShapeSearch shape_search(std::string const& optimiser, std::uint64_t seed, std::int64_t members = 10);

struct RefinedEffect {
  Effect const* effect = nullptr;
  std::vector<double> shape{};
  Eigen::VectorXd parameters{};  // linear
  double gain = 0.0;             // energy of `mismatch` explained, signs kept, less what noise alone gives there
  double plain_gain = 0.0;       // the same of its form without shapes, where it has one
  std::int64_t evaluations = 0;
  // whenever a shape explained more: evaluations until then, and what it explains before chance is taken off
  struct Improvement {
    std::int64_t evaluations = 0;
    double gain = 0.0;
  };
  std::vector<Improvement> improvements{};
};

// mismatch: n rows. Where the best shape is none that the effect could have (Effect::is_plausible), the best that it
// could have if that explains nine tenths of it, which is what the form of a law may cost; else the best of all, for
// the caller to refuse
RefinedEffect refine_shape(CandidateColumns const& columns, EffectScan const& scan, Eigen::VectorXd const& mismatch,
                           ShapeSearch const& search, int threads);

// the best that it could have, begun at the grid's point that explains most of the mismatch on these columns' motion;
// nothing where none explains any
std::optional<RefinedEffect> refine_plausible(CandidateColumns const& columns, EffectScan const& scan,
                                              Eigen::VectorXd const& mismatch, ShapeSearch const& search, int threads);

// the same in two steps, for several searches from one point
std::optional<std::size_t> best_plausible_point(CandidateColumns const& columns, EffectScan const& scan,
                                                Eigen::VectorXd const& mismatch, int threads);
RefinedEffect refine_plausible_from(CandidateColumns const& columns, EffectScan const& scan, std::size_t point,
                                    Eigen::VectorXd const& mismatch, ShapeSearch const& search, int threads);

}  // namespace torquescope
