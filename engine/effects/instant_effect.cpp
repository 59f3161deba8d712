#include "engine/effects/instant_effect.hpp"

#include <algorithm>
#include <array>

#include "engine/base/contract.hpp"

namespace torquescope {
namespace {

constexpr std::size_t most_columns = 8;  // of an effect

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
  TORQUESCOPE_EXPECT(takes_shape(shape.size()));
  TORQUESCOPE_EXPECT(out.rows() == input.size() && out.cols() == static_cast<Eigen::Index>(n_linear()));
  static Eigen::ArrayXd const nothing = Eigen::ArrayXd::Zero(states_at_once);
  for (Eigen::Index first = 0; first < input.size(); first += states_at_once) {
    Eigen::Index const n = std::min(states_at_once, input.size() - first);
    auto const part = [&](double const* whole) {
      return JointStates::Quantity(whole != nullptr ? whole + first : nothing.data(), n);
    };
    auto const& motion = input.motion;
    JointStates const at{part(motion.time_s.data()), part(motion.q.data()),          part(motion.dq.data()),
                         part(motion.ddq.data()),    part(input.load_torque.data()), part(input.model_torque.data())};
    evaluate(at, shape, input.scales, out.middleRows(first, n).array());
  }
}

std::unique_ptr<EffectRunner> InstantEffect::runner(std::span<double const> parameters,
                                                    JointScales const& scales) const {
  TORQUESCOPE_EXPECT(parameters.size() >= n_linear() && takes_shape(parameters.size() - n_linear()));
  return std::make_unique<InstantRunner>(*this, parameters, scales);
}

double InstantEffect::torque(JointState const& state, std::span<double const> parameters,
                             JointScales const& scales) const {
  double torque = 0.0;
  torques(JointStates::of(state), parameters, scales, {&torque, 1});
  return torque;
}

void InstantEffect::torques(JointStates const& at, std::span<double const> parameters, JointScales const& scales,
                            std::span<double> out) const {
  TORQUESCOPE_EXPECT(parameters.size() >= n_linear() && takes_shape(parameters.size() - n_linear()));
  TORQUESCOPE_EXPECT(at.size() <= states_at_once && out.size() == static_cast<std::size_t>(at.size()));
  std::array<double, most_columns * states_at_once> values;
  Eigen::Map<Eigen::ArrayXXd> columns(values.data(), at.size(), static_cast<Eigen::Index>(n_linear()));
  evaluate(at, parameters.subspan(n_linear()), scales, columns);
  Eigen::Map<Eigen::ArrayXd> sum(out.data(), at.size());
  sum.setZero();
  for (Eigen::Index k = 0; k < columns.cols(); ++k) sum += parameters[static_cast<std::size_t>(k)] * columns.col(k);
}

void InstantEffect::torques_of_each(JointStates const& at, ParametersOfEach const& parameters,
                                    JointScales const& scales, std::span<double> out) const {
  auto const linear = static_cast<Eigen::Index>(n_linear());
  TORQUESCOPE_EXPECT(parameters.rows() == at.size() && parameters.cols() >= linear);
  TORQUESCOPE_EXPECT(takes_shape(static_cast<std::size_t>(parameters.cols() - linear)));
  TORQUESCOPE_EXPECT(at.size() <= states_at_once && out.size() == static_cast<std::size_t>(at.size()));
  std::array<double, most_columns * states_at_once> values;
  Eigen::Map<Eigen::ArrayXXd> columns(values.data(), at.size(), linear);
  if (parameters.cols() == linear)
    evaluate(at, {}, scales, columns);
  else
    evaluate_each(at, parameters.rightCols(parameters.cols() - linear), scales, columns);
  Eigen::Map<Eigen::ArrayXd> sum(out.data(), at.size());
  sum.setZero();
  for (Eigen::Index k = 0; k < linear; ++k) sum += parameters.col(k) * columns.col(k);
}

void InstantEffect::evaluate_each(JointStates const& at, ParametersOfEach const& shapes, JointScales const& scales,
                                  EffectColumns out) const {
  std::array<double, most_columns> shape;
  auto const n = static_cast<std::size_t>(shapes.cols());
  TORQUESCOPE_EXPECT(n <= shape.size());
  for (Eigen::Index i = 0; i < at.size(); ++i) {
    for (std::size_t k = 0; k < n; ++k) shape[k] = shapes(i, static_cast<Eigen::Index>(k));
    evaluate(at.only(i), {shape.data(), n}, scales, out.middleRows(i, 1));
  }
}

}  // namespace torquescope
