#include "engine/effects/given_effect.hpp"

#include <utility>

#include "engine/base/contract.hpp"
#include "engine/base/error.hpp"

namespace torquescope {

namespace {

EffectDescription given(EffectDescription description) {
  description.is_given = true;
  return description;
}

}  // namespace

GivenEffect::GivenEffect(EffectDescription description) : Effect(given(std::move(description))) {}

void GivenEffect::columns(EffectInput const& input, std::span<double const>, Eigen::Ref<Eigen::MatrixXd> out) const {
  Eigen::MatrixXd const* known = input.given != nullptr ? input.given->of(name()) : nullptr;
  if (known == nullptr) {
    out.setZero();
    return;
  }
  TORQUESCOPE_EXPECT(known->rows() == out.rows() && known->cols() == out.cols());
  out = *known;
}

std::unique_ptr<EffectRunner> GivenEffect::runner(std::span<double const>, JointScales const&) const {
  Problem problem{ExitCode::bad_job, "effect \"" + name() + "\" acts on several joints"};
  problem.help = "one joint alone cannot be simulated with it: leave it out";
  throw Error(problem);
}

double GivenEffect::torque(JointState const&, std::span<double const>, JointScales const&) const { return 0.0; }

}  // namespace torquescope
