#include "engine/effects/memory_effect.hpp"

#include <array>
#include <utility>

#include "engine/base/contract.hpp"

namespace torquescope {
namespace {

class MemoryRunner final : public EffectRunner {
 public:
  MemoryRunner(std::unique_ptr<EffectMemory> memory, std::span<double const> linear)
      : memory_(std::move(memory)), linear_(linear.begin(), linear.end()) {}

  void advance(JointState const& state, double step_s) override {
    if (std::exchange(has_started_, true))
      memory_->advance(state, step_s);
    else
      memory_->start(state);
  }

  double torque(JointState const& state) const override {
    std::array<double, 8> values{};
    memory_->row(state, std::span(values).first(linear_.size()));
    double sum = 0.0;
    for (std::size_t k = 0; k < linear_.size(); ++k) sum += linear_[k] * values[k];
    return sum;
  }

 private:
  std::unique_ptr<EffectMemory> memory_;
  std::vector<double> linear_;
  bool has_started_ = false;
};

}  // namespace

void MemoryEffect::columns(EffectInput const& input, std::span<double const> shape,
                           Eigen::Ref<Eigen::MatrixXd> out) const {
  TORQUESCOPE_EXPECT(shape.size() == n_shape());
  TORQUESCOPE_EXPECT(out.rows() == input.size() && out.cols() == static_cast<Eigen::Index>(n_linear()));
  auto const state = memory(shape, input.scales);
  std::array<double, 8> values{};
  auto const one_row = std::span(values).first(n_linear());
  for (Eigen::Index i = 0; i < input.size(); ++i) {
    auto const now = input.state(i);
    if (i == 0)
      state->start(now);
    else
      state->advance(now, input.motion.time_s[i] - input.motion.time_s[i - 1]);
    state->row(now, one_row);
    for (Eigen::Index k = 0; k < out.cols(); ++k) out(i, k) = values[static_cast<std::size_t>(k)];
  }
}

std::unique_ptr<EffectRunner> MemoryEffect::runner(std::span<double const> parameters,
                                                   JointScales const& scales) const {
  TORQUESCOPE_EXPECT(parameters.size() == n_linear() + n_shape());
  return std::make_unique<MemoryRunner>(memory(parameters.subspan(n_linear()), scales), parameters.first(n_linear()));
}

}  // namespace torquescope
