// Dry friction that walks at random: dirt, wear, a gasket that settles.
//
// Equation   s amplitude w(t); w walks a normal step every knot_s and is a straight line between
#include <cmath>

#include "concealed/effects/laws.hpp"
#include "concealed/noise.hpp"

namespace concealed {
namespace {

constexpr double knot_s = 3.0;
constexpr std::size_t n_knots = 200;

class WanderingFriction final : public HiddenEffect {
 public:
  WanderingFriction(double amplitude, std::uint64_t seed) : amplitude_(amplitude) {
    Random random(seed, "walk");
    double here = 0.0;
    for (std::size_t i = 0; i < n_knots; ++i) {
      walk_.push_back(here);
      here += random.normal();
    }
  }
  double dry(Instant const& now, double const*) const override {
    double const place = std::min(now.t / knot_s, static_cast<double>(n_knots) - 1.5);
    auto const i = static_cast<std::size_t>(place);
    return amplitude_ * std::lerp(walk_[i], walk_[i + 1], place - static_cast<double>(i));
  }

 private:
  double amplitude_;
  std::vector<double> walk_;
};

}  // namespace

Effect wandering_friction(double amplitude, std::uint64_t seed) {
  return std::make_shared<WanderingFriction>(amplitude, seed);
}

}  // namespace concealed
