#include "engine/effects/effect.hpp"

#include <algorithm>
#include <utility>

#include "engine/base/contract.hpp"

namespace torquescope {
namespace {

std::vector<ParameterRange> ranges(std::span<EffectParameter const> parameters, JointScales const& scales) {
  std::vector<ParameterRange> found;
  for (auto const& parameter : parameters)
    found.push_back({bound_value(parameter.lower, scales), bound_value(parameter.upper, scales), parameter.spacing});
  return found;
}

}  // namespace

JointState EffectInput::state(Eigen::Index sample) const {
  auto const i = static_cast<std::size_t>(sample);
  return {motion.time_s[sample],
          motion.q[sample],
          motion.dq[sample],
          motion.ddq[sample],
          load_torque.empty() ? 0.0 : load_torque[i],
          model_torque.empty() ? 0.0 : model_torque[i]};
}

Effect::Effect(EffectDescription description) : description_(std::move(description)) {
  auto const is_shape = [](EffectParameter const& parameter) { return parameter.is_shape; };
  auto const& all = description_.parameters;
  auto const first_shape = std::find_if(all.begin(), all.end(), is_shape);
  n_linear_ = static_cast<std::size_t>(first_shape - all.begin());
  TORQUESCOPE_EXPECT(n_linear_ >= 1 && (description_.is_given || n_linear_ <= (is_of_whole_arm() ? 10u : 8u)));
  TORQUESCOPE_EXPECT(std::all_of(first_shape, all.end(), is_shape));
  TORQUESCOPE_EXPECT(!description_.families.empty());
}

bool Effect::exists_on(JointKind joint) const {
  return std::any_of(parameters().begin(), parameters().end(), [joint](EffectParameter const& parameter) {
    return !parameter.is_shape && !parameter.unit_for(joint).empty();
  });
}

bool Effect::is_event() const {
  return std::any_of(parameters().begin(), parameters().end(), [](auto const& one) { return one.is_instant(); });
}

bool Effect::may_come_again() const { return is_wave() || is_event(); }

bool Effect::is_wave() const {
  return n_shape() > 0 && (parameters()[n_linear_].is_order() || parameters()[n_linear_].is_frequency());
}

std::vector<ParameterRange> Effect::shape_bounds(JointScales const& scales) const {
  return ranges(std::span(parameters()).subspan(n_linear_), scales);
}

std::vector<ParameterRange> Effect::linear_bounds(JointScales const& scales) const {
  return ranges(std::span(parameters()).first(n_linear_), scales);
}

bool Effect::is_plain_term() const {
  return takes_shape(0) && !has_memory() && !needs_baseline() && !is_given() && acts_on() == ActsOn::joint;
}

void Effect::columns_of_shapes(EffectInput const& input, std::vector<std::vector<double>> const& shapes,
                               Eigen::Ref<Eigen::MatrixXd> out) const {
  auto const linear = static_cast<Eigen::Index>(n_linear());
  TORQUESCOPE_EXPECT(out.cols() == linear * static_cast<Eigen::Index>(shapes.size()));
  Eigen::Index first = 0;
  for (auto const& shape : shapes) {
    columns(input, shape, out.middleCols(first, linear));
    first += linear;
  }
}

double Effect::torque(JointState const& state, std::span<double const> parameters, JointScales const& scales) const {
  return runner(parameters, scales)->torque(state, 0.0);
}

bool Effect::is_plausible(std::span<double const>, JointScales const&) const { return true; }

}  // namespace torquescope
