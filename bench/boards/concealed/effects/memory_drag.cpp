// A magnetorheological fluid: its chains build up at rest and break under shear, so the drag depends on the history of
// the speed and on no present quantity alone.
#include <cmath>

#include "concealed/effects/laws.hpp"

namespace concealed {
namespace {

class MemoryDrag final : public HiddenEffect {
 public:
  MemoryDrag(double drag, double build_s, double break_per_unit, double knee)
      : drag_(drag), build_s_(build_s), break_per_unit_(break_per_unit), knee_(knee) {}
  std::size_t n_states() const override { return 1; }
  void start(double, double* z) const override { z[0] = 1.0; }
  void rates(Instant const& now, double const* z, double* dz) const override {
    dz[0] = (1.0 - z[0]) / build_s_ - break_per_unit_ * std::abs(now.v) * z[0];
  }
  double torque(Instant const& now, double const* z) const override {
    return drag_ * z[0] * z[0] * now.v / std::sqrt(now.v * now.v + knee_ * knee_);
  }

 private:
  double drag_, build_s_, break_per_unit_, knee_;
};

}  // namespace

Effect memory_drag(double drag, double build_s, double break_per_unit, double knee) {
  return std::make_shared<MemoryDrag>(drag, build_s, break_per_unit, knee);
}

}  // namespace concealed
