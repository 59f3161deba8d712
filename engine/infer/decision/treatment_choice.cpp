#include "engine/infer/decision/treatment_choice.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/base/dense_solvers.hpp"

namespace torquescope {
namespace {

// what least squares leave, by the normal equations of columns of length one
double energy_left(Eigen::MatrixXd const& columns, Eigen::VectorXd const& torque) {
  constexpr double ridge = 1e-12;
  Eigen::VectorXd const length = columns.colwise().norm().transpose().cwiseMax(std::numeric_limits<double>::min());
  Eigen::MatrixXd gram = columns.transpose() * columns;
  gram.array() /= (length * length.transpose()).array();
  gram.diagonal().array() += ridge;
  Eigen::VectorXd const right = (columns.transpose() * torque).cwiseQuotient(length);
  return torque.squaredNorm() - right.dot(solve_semidefinite(gram, right));
}

// the place of least value of a parabola through three points; the middle where it has none inside
double vertex(double left, double middle, double right, double step) {
  double const bend = left - 2.0 * middle + right;
  return bend > 0.0 ? std::clamp(0.5 * step * (left - right) / bend, -step, step) : 0.0;
}

class Choice {
 public:
  Choice(ModelOnStrips const& on, double longest_s) : on_(on), longest_s_(longest_s), fit_(treated_fit(on, 0.0)) {
    auto const& filters = *on.strips().front().filters;
    double const cutoff_hz = filters.cutoff_hz > 0.0 ? filters.cutoff_hz : 0.25 * filters.rate_hz;
    step_s_ = 0.125 / cutoff_hz;
  }

  void everywhere() {
    double best = left(0.0), at = 0.0;
    for (double late = step_s_; late <= longest_s_; late += step_s_)
      for (double const side : {late, -late})
        if (double const energy = left(side); energy < best) {
          best = energy;
          at = side;
        }
    move_to(at);
  }

  void nearby() {
    double const at = late_s_, step = 0.5 * step_s_;
    double const moved = at + vertex(left(at - step), left(at), left(at + step), step);
    if (moved != at && left(moved) < left(at)) move_to(moved);
  }

  ChosenTreatment result() && {
    bool const at_bound = std::abs(late_s_) > longest_s_ - step_s_ && late_s_ != 0.0;
    if (at_bound) move_to(0.0);
    return {late_s_, std::move(fit_), at_bound};
  }

 private:
  void move_to(double late_s) {
    if (late_s == late_s_) return;
    late_s_ = late_s;
    fit_ = treated_fit(on_, late_s);
  }

  double left(double late_s) const { return energy_left(fit_.columns, torque_on_rows(on_, fit_.samples, late_s)); }

  ModelOnStrips const& on_;
  double longest_s_, step_s_ = 0.0, late_s_ = 0.0;
  TreatedFit fit_;
};

}  // namespace

ChosenTreatment chosen_treatment(ModelOnStrips const& on, DelayChoice const& delay) {
  if (delay.search == DelaySearch::given) return {delay.given_s, treated_fit(on, delay.given_s), false};
  Choice choice(on, delay.longest_s);
  if (delay.search == DelaySearch::everywhere) choice.everywhere();
  choice.nearby();
  choice.nearby();
  return std::move(choice).result();
}

Eigen::VectorXd delay_tangent(ModelOnStrips const& on, TreatedFit const& fit) {
  Eigen::VectorXd tangent(on.rows());
  Eigen::Index row = 0;
  for (std::size_t i = 0; i < on.strips().size(); ++i) {
    Strip const& strip = on.strips()[i];
    Eigen::VectorXd const slope =
        central_derivative(model_torque(on, i, fit.samples[i], fit.parameters), strip.motion.rate_hz);
    Eigen::VectorXd const rows = on_rows(strip, fit.samples[i].weight.cwiseProduct(slope)).col(0);
    tangent.segment(row, rows.size()) = rows;
    row += rows.size();
  }
  return tangent;
}

StickingBounds plausible_sticking(ModelOnStrips const& on, ChosenTreatment const& chosen, double odds) {
  StickingBounds const whole = sticking_bounds(on.strips().front().resolution);
  StickingSizes const sizes = sticking_sizes(whole);
  double const most = odds * chosen.fit.energy();
  auto const is_plausible = [&](std::size_t shape) {
    auto samples = chosen.fit.samples;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      Strip const& strip = on.strips()[i];
      auto const side = strip.sides.col(static_cast<Eigen::Index>(shape));
      for (Eigen::Index k = 0; k < strip.size(); ++k)
        if (strip.is_quiet[static_cast<std::size_t>(k)] == 0) samples[i].side[k] = side[k];
    }
    return energy_left(model_on_rows(on, samples), chosen.fit.torque) <= most;
  };
  StickingBounds plausible{whole.least_creep, whole.least_creep, whole.least_length, whole.least_length};
  for (std::size_t k = 0; k < sizes.creeps.size(); ++k)
    if (is_plausible(k)) plausible.most_creep = sizes.creeps[k];
  for (std::size_t k = 0; k < sizes.lengths.size(); ++k)
    if (is_plausible(sizes.creeps.size() + k)) plausible.most_length = sizes.lengths[k];
  return plausible;
}

}  // namespace torquescope
