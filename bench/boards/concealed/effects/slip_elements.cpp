// A part of the dry friction that builds up in three elements side by side, each over its own distance.
//
// State      z_i in (-1, 1), the share of its strength that an element holds
// Equation   dz/dx = (1 - |z|^4 (1 + sign(z dx)) / 2) / distance (Bouc, Wen: stiff when it turns back, slipping at 1)
#include <array>
#include <cmath>

#include "concealed/effects/laws.hpp"

namespace concealed {
namespace {

struct Element {
  double share, distance;  // of the strength, of the longest distance
};
constexpr std::array<Element, 3> elements = {{{0.5, 1.0}, {0.3, 0.35}, {0.2, 0.08}}};

class SlipElements final : public HiddenEffect {
 public:
  SlipElements(double strength, double distance) : strength_(strength), distance_(distance) {}
  std::size_t n_states() const override { return elements.size(); }
  void rates(Instant const& now, double const* z, double* dz) const override {
    for (std::size_t i = 0; i < elements.size(); ++i) {
      double const full = z[i] * now.v > 0.0 ? z[i] * z[i] * z[i] * z[i] : 0.0;
      dz[i] = now.v * (1.0 - full) / (elements[i].distance * distance_);
    }
  }
  double torque(Instant const&, double const* z) const override {
    double sum = 0.0;
    for (std::size_t i = 0; i < elements.size(); ++i) sum += elements[i].share * z[i];
    return strength_ * sum;
  }
  double dry(Instant const&, double const*) const override { return -strength_; }

 private:
  double strength_, distance_;
};

}  // namespace

Effect slip_elements(double strength, double distance) { return std::make_shared<SlipElements>(strength, distance); }

}  // namespace concealed
