#include "engine/infer/decision/own_clock.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "engine/effects/carry_over.hpp"
#include "engine/fit/statistics/bounded_projection.hpp"
#include "engine/infer/decision/own_event.hpp"

namespace torquescope {
namespace {

Eigen::Index width_of(ShapedEffect const& one) { return static_cast<Eigen::Index>(one.effect->n_linear()); }

// columns of one effect at several shapes, less the recording's offset
std::vector<Eigen::MatrixXd> columns_there(ElsewhereRows const& rows, Effect const& effect,
                                           std::vector<std::vector<double>> const& shapes) {
  Strip const& strip = rows.on.strips().front();
  Eigen::MatrixXd const all =
      columns_on_rows(rows.on.strips(), {columns_of(effect, shapes, strip, rows.on.baseline(0))}, rows.samples);
  auto const width = static_cast<Eigen::Index>(effect.n_linear());
  double const whole = rows.constant.squaredNorm();
  std::vector<Eigen::MatrixXd> each;
  for (std::size_t k = 0; k < shapes.size(); ++k) {
    each.emplace_back(all.middleCols(static_cast<Eigen::Index>(k) * width, width));
    if (whole > 0.0) each.back() -= rows.constant * (rows.constant.transpose() * each.back() / whole);
  }
  return each;
}

Eigen::VectorXd less_event(ElsewhereRows const& rows, Effect const& effect, Eigen::VectorXd residual) {
  Strip const& strip = rows.on.strips().front();
  EventQuestion question;
  question.effect = &effect;
  question.scales = scales_during(rows.on.model().reference().scales, strip.motion.time_s);
  question.memory_rows = std::max<Eigen::Index>(strip.memory(), 1);
  auto const own = own_event(
      question, [&](auto const& shapes) { return columns_there(rows, effect, shapes); }, residual);
  if (!own) return residual;
  Eigen::MatrixXd const basis = orthonormal_basis(own->columns);
  return residual - basis * (basis.transpose() * residual);
}

Eigen::VectorXd less_share(Eigen::VectorXd const& torque, Eigen::VectorXd residual) {
  double const whole = torque.squaredNorm();
  if (!(whole > 0.0)) return residual;
  return residual - std::clamp(torque.dot(residual) / whole, 0.0, 1.0) * torque;
}

Eigen::VectorXd less_wave(Eigen::MatrixXd const& columns, Eigen::VectorXd const& residual) {
  Eigen::MatrixXd const basis = orthonormal_basis(columns);
  return residual - basis * (basis.transpose() * residual);
}

}  // namespace

Eigen::VectorXd without_clock(JointModel const& model, Eigen::VectorXd parameters) {
  for (std::size_t i = 0; i < model.effects().size(); ++i)
    if (is_clock_bound(*model.effects()[i].effect))
      parameters.segment(static_cast<Eigen::Index>(model.first_parameter(i)), width_of(model.effects()[i])).setZero();
  return parameters;
}

Eigen::VectorXd less_own_clock(ElsewhereRows const& rows, Eigen::VectorXd residual) {
  JointModel const& model = rows.on.model();
  for (std::size_t i = 0; i < model.effects().size(); ++i) {
    ShapedEffect const& one = model.effects()[i];
    if (!is_clock_bound(*one.effect)) continue;
    auto const columns = [&] { return columns_there(rows, *one.effect, {one.shape}).front(); };
    switch (carry_over(*one.effect)) {
      case CarryOver::in_frequency:
        residual = less_wave(columns(), residual);
        break;
      case CarryOver::in_part:
        residual = less_share(
            columns() * rows.parameters.segment(static_cast<Eigen::Index>(model.first_parameter(i)), width_of(one)),
            std::move(residual));
        break;
      default:
        residual = less_event(rows, *one.effect, std::move(residual));
    }
  }
  return residual;
}

}  // namespace torquescope
