#include "engine/effects/memory_effect.hpp"

#include <algorithm>

namespace torquescope {
namespace {

// one lane
class MemoryRunner final : public EffectRunner {
 public:
  MemoryRunner(std::unique_ptr<EffectMemory> memory, std::span<double const> linear)
      : memory_(std::move(memory)), linear_(1, static_cast<Eigen::Index>(linear.size())) {
    std::copy(linear.begin(), linear.end(), linear_.data());
  }

  void advance(JointState const& state, double step_s) override { memory_->advance(JointStates::of(state), step_s); }

  double torque(JointState const& state) const override {
    double torque = 0.0;
    memory_->torques(JointStates::of(state), linear_, {&torque, 1});
    return torque;
  }

 private:
  std::unique_ptr<EffectMemory> memory_;
  Eigen::ArrayXXd linear_;
};

}  // namespace

void MemoryEffect::columns(EffectInput const& input, std::span<double const> shape,
                           Eigen::Ref<Eigen::MatrixXd> out) const {
  TORQUESCOPE_EXPECT(shape.size() == n_shape());
  TORQUESCOPE_EXPECT(out.rows() == input.size() && out.cols() == static_cast<Eigen::Index>(n_linear()));
  memory(shape, input.scales, 1)->columns(input, out);
}

void MemoryEffect::columns_of_shapes(EffectInput const& input, std::vector<std::vector<double>> const& shapes,
                                     Eigen::Ref<Eigen::MatrixXd> out) const {
  TORQUESCOPE_EXPECT(out.rows() == input.size() && out.cols() == static_cast<Eigen::Index>(n_linear() * shapes.size()));
  if (shapes.empty()) return;
  auto const all = memory(shapes.front(), input.scales, 1);
  for (std::size_t i = 1; i < shapes.size(); ++i) all->append(*memory(shapes[i], input.scales, 1));
  all->columns(input, out);
}

std::unique_ptr<EffectRunner> MemoryEffect::runner(std::span<double const> parameters,
                                                   JointScales const& scales) const {
  TORQUESCOPE_EXPECT(parameters.size() == n_linear() + n_shape());
  return std::make_unique<MemoryRunner>(memory(parameters.subspan(n_linear()), scales, 1),
                                        parameters.first(n_linear()));
}

}  // namespace torquescope
