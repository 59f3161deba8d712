#include "engine/effects/instant_effect.hpp"

#include <array>

#include "engine/base/contract.hpp"

namespace torquescope {
namespace {

class InstantRunner final : public EffectRunner {
 public:
  InstantRunner(InstantEffect const& effect, std::span<double const> parameters, JointScales const& scales)
      : effect_(effect), parameters_(parameters.begin(), parameters.end()), scales_(scales) {}
  void advance(JointState const&, double) override {}
  double torque(JointState const& state) const override { return effect_.torque(state, parameters_, scales_); }

 private:
  InstantEffect const& effect_;
  std::vector<double> parameters_;
  JointScales scales_;
};

}  // namespace

void InstantEffect::columns(EffectInput const& input, std::span<double const> shape,
                            Eigen::Ref<Eigen::MatrixXd> out) const {
  TORQUESCOPE_EXPECT(shape.size() == n_shape());
  TORQUESCOPE_EXPECT(out.rows() == input.size() && out.cols() == static_cast<Eigen::Index>(n_linear()));
  std::array<double, 8> values{};
  auto const one_row = std::span(values).first(n_linear());
  for (Eigen::Index i = 0; i < input.size(); ++i) {
    row(input.state(i), shape, input.scales, one_row);
    for (Eigen::Index k = 0; k < out.cols(); ++k) out(i, k) = values[static_cast<std::size_t>(k)];
  }
}

std::unique_ptr<EffectRunner> InstantEffect::runner(std::span<double const> parameters,
                                                    JointScales const& scales) const {
  TORQUESCOPE_EXPECT(parameters.size() == n_linear() + n_shape());
  return std::make_unique<InstantRunner>(*this, parameters, scales);
}

double InstantEffect::torque(JointState const& state, std::span<double const> parameters,
                             JointScales const& scales) const {
  TORQUESCOPE_EXPECT(parameters.size() == n_linear() + n_shape());
  std::array<double, 8> values{};
  row(state, parameters.subspan(n_linear()), scales, std::span(values).first(n_linear()));
  double sum = 0.0;
  for (std::size_t k = 0; k < n_linear(); ++k) sum += parameters[k] * values[k];
  return sum;
}

}  // namespace torquescope
