#include "engine/fit/optim/fuzzy_curves.hpp"

#include "engine/base/contract.hpp"

namespace torquescope {

namespace {

std::vector<double> equally_spaced(double top, std::size_t n_points) {
  TORQUESCOPE_EXPECT(n_points >= 2);
  std::vector<double> points(n_points);
  for (std::size_t p = 0; p < n_points; ++p) {
    points[p] = top * static_cast<double>(p) / static_cast<double>(n_points - 1);
  }
  return points;
}

MembershipCurves curves_of(FuzzyVariable const& variable, std::size_t n_points) {
  MembershipCurves curves{variable, equally_spaced(variable.top, n_points), {}};
  for (double const x : curves.x) {
    auto const levels = memberships(variable, x);
    for (std::size_t k = 0; k < levels.size(); ++k) curves.memberships[k].push_back(levels[k]);
  }
  return curves;
}

}  // namespace

std::vector<MembershipCurves> membership_curves(FuzzyController const& controller, std::size_t n_points) {
  std::vector<MembershipCurves> all;
  for (auto const* system : {&controller.F_system(), &controller.CR_system()}) {
    for (auto const* variable : {&system->first(), &system->second(), &system->output()}) {
      all.push_back(curves_of(*variable, n_points));
    }
  }
  return all;
}

DecisionSurface decision_surface(MamdaniSystem const& system, std::size_t n_points) {
  DecisionSurface surface{system.first().name,
                          system.second().name,
                          system.output().name,
                          equally_spaced(system.first().top, n_points),
                          equally_spaced(system.second().top, n_points),
                          {}};
  surface.output.reserve(n_points * n_points);
  for (double const first : surface.first) {
    for (double const second : surface.second) surface.output.push_back(system(first, second));
  }
  return surface;
}

}  // namespace torquescope
