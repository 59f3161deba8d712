#include "engine/infer/decision/treated_fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/fit/statistics/scaled_solution.hpp"

namespace torquescope {
namespace {

BaselineReference reference_on(BaselineReference reference, Strip const& strip) {
  reference.gear_load = strip.beside.gear_load;
  reference.given = strip.beside.given;
  reference.rate_hz = strip.beside.rate_hz;
  return reference;
}

// of the model without further offsets, one per sample at the effects' rate
struct SampleTorque {
  Eigen::VectorXd smooth, forward, backward;  // of all that is no dry friction; of dry friction either way
};

Eigen::VectorXd at_effect_rate(Strip const& strip, Eigen::VectorXd const& driven) {
  auto const& filters = *strip.filters;
  if (filters.step == filters.drive_step) return driven;
  Eigen::Index const first = filters.whole->first_of(filters.step), drive = filters.whole->first_of(filters.drive_step);
  Eigen::VectorXd at(strip.size());
  for (Eigen::Index k = 0; k < at.size(); ++k) {
    Eigen::Index const sample = first + k * filters.step - drive;
    at[k] = driven[std::clamp<Eigen::Index>(sample / filters.drive_step, 0, driven.size() - 1)];
  }
  return at;
}

SampleTorque sample_torque(ModelOnStrips const& on, std::size_t strip, Eigen::VectorXd const& parameters) {
  Strip const& here = on.strips()[strip];
  SampleTorque torque;
  torque.smooth = torque.forward = torque.backward = Eigen::VectorXd::Zero(here.size());
  Eigen::Index first = 0;
  for (auto const& part : on.parts(strip)) {
    Eigen::VectorXd own = parameters.segment(first, part.count());
    for (std::size_t i = 0; i < part.dry.size(); ++i) {
      double const value = std::exchange(own[part.dry[i]], 0.0);
      torque.forward += value * part.forward.col(part.dry[i]);
      torque.backward += value * part.backward.col(static_cast<Eigen::Index>(i));
    }
    Eigen::VectorXd const smooth = part.forward * own;
    torque.smooth += part.is_driven ? at_effect_rate(here, smooth) : smooth;
    first += part.count();
  }
  if (strip > 0) torque.smooth.array() += parameters[first + static_cast<Eigen::Index>(strip) - 1];
  return torque;
}

bool are_same(std::vector<SampleTreatment> const& a, std::vector<SampleTreatment> const& b) {
  for (std::size_t i = 0; i < a.size(); ++i)
    if (a[i].weight != b[i].weight) return false;
  return true;
}

// level of dry friction times what each side differs from the sign; n x shapes
Eigen::MatrixXd sticking_columns(ModelOnStrips const& on, std::size_t strip, Eigen::VectorXd const& parameters) {
  Strip const& here = on.strips()[strip];
  SampleTorque const torque = sample_torque(on, strip, parameters);
  Eigen::MatrixXd columns =
      (0.5 * (torque.forward - torque.backward)).asDiagonal() * (here.sides.colwise() - here.direction);
  for (Eigen::Index k = 0; k < here.size(); ++k)
    if (here.is_quiet[static_cast<std::size_t>(k)] != 0) columns.row(k).setZero();
  return columns;
}

Eigen::MatrixXd sticking_columns_on_rows(ModelOnStrips const& on, std::vector<SampleTreatment> const& samples,
                                         Eigen::VectorXd const& parameters) {
  Eigen::MatrixXd all(on.rows(), on.strips().front().sides.cols());
  Eigen::Index row = 0;
  for (std::size_t i = 0; i < on.strips().size(); ++i) {
    Eigen::MatrixXd const rows =
        on_rows(on.strips()[i], samples[i].weight.asDiagonal() * sticking_columns(on, i, parameters));
    all.middleRows(row, rows.rows()) = rows;
    row += rows.rows();
  }
  return all;
}

// weights from 0 to 1, at most 1 in all, that leave the least beside the model's columns
Eigen::VectorXd fitted_sticking(Eigen::MatrixXd const& model, Eigen::MatrixXd const& sticking,
                                Eigen::VectorXd const& torque) {
  constexpr double free = std::numeric_limits<double>::infinity();
  Eigen::Index const k = model.cols(), shapes = sticking.cols();
  Eigen::MatrixXd all(model.rows(), k + shapes);
  all << model, sticking;
  CoefficientBounds bounds{Eigen::VectorXd::Constant(k + shapes, -free), Eigen::VectorXd::Constant(k + shapes, free)};
  bounds.lower.tail(shapes).setZero();
  bounds.upper.tail(shapes).setOnes();
  Eigen::VectorXd const weights = solve_scaled(all, torque, bounds).col(0).tail(shapes);
  return weights / std::max(1.0, weights.sum());
}

}  // namespace

ModelOnStrips::ModelOnStrips(JointModel const& model, std::span<Strip const> strips) : model_(&model), strips_(strips) {
  for (auto const& strip : strips) {
    std::vector<EffectColumnsOnStrip> parts{columns_of(model.regressor(), strip)};
    baselines_.emplace_back();
    if (model.reference().parameters.size() > 0) {
      baselines_.back() = on_motion(model.regressor(), reference_on(model.reference(), strip), strip.motion);
      for (auto const& [effect, shape] : model.effects())
        parts.push_back(columns_of(*effect, {shape}, strip, baselines_.back()));
    }
    parts_.push_back(std::move(parts));
  }
}

Eigen::Index ModelOnStrips::rows() const {
  Eigen::Index rows = 0;
  for (auto const& strip : strips_) rows += static_cast<Eigen::Index>(strip.rows.size());
  return rows;
}

Eigen::Index ModelOnStrips::parameters() const {
  return static_cast<Eigen::Index>(model_->size() + strips_.size()) - 1;
}

Eigen::VectorXd earlier(Eigen::VectorXd const& signal, double late_s, double rate_hz) {
  Eigen::Index const n = signal.size();
  if (late_s == 0.0 || n < 4) return signal;
  double const samples = late_s * rate_hz, whole = std::floor(samples), u = samples - whole;
  // Lagrange's cubic through the samples around it
  double const before = -u * (u - 1.0) * (u - 2.0) / 6.0, here = (u + 1.0) * (u - 1.0) * (u - 2.0) / 2.0;
  double const next = -(u + 1.0) * u * (u - 2.0) / 2.0, after = (u + 1.0) * u * (u - 1.0) / 6.0;
  auto const shift = static_cast<Eigen::Index>(whole);
  auto const at = [&](Eigen::Index k) { return signal[std::clamp<Eigen::Index>(k, 0, n - 1)]; };
  Eigen::VectorXd moved(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    Eigen::Index const i = k + shift;
    moved[k] = before * at(i - 1) + here * at(i) + next * at(i + 1) + after * at(i + 2);
  }
  return moved;
}

Eigen::VectorXd torque_on_rows(ModelOnStrips const& on, std::vector<SampleTreatment> const& samples, double late_s) {
  Eigen::VectorXd all(on.rows());
  Eigen::Index first = 0;
  for (std::size_t i = 0; i < on.strips().size(); ++i) {
    Strip const& strip = on.strips()[i];
    Eigen::VectorXd const weighed = samples[i].weight.cwiseProduct(earlier(strip.torque, late_s, strip.motion.rate_hz));
    Eigen::VectorXd const rows = on_rows(strip, weighed).col(0);
    all.segment(first, rows.size()) = rows;
    first += rows.size();
  }
  return all;
}

Eigen::MatrixXd columns_on_rows(std::span<Strip const> strips, std::vector<EffectColumnsOnStrip> const& columns,
                                std::vector<SampleTreatment> const& samples) {
  std::vector<Eigen::MatrixXd> each;
  Eigen::Index rows = 0, first = 0;
  for (std::size_t i = 0; i < strips.size(); ++i) {
    each.push_back(on_rows(strips[i], columns[i], samples[i].side, samples[i].weight));
    rows += each.back().rows();
  }
  if (each.size() == 1) return std::move(each.front());
  Eigen::MatrixXd all(rows, each.front().cols());
  for (auto const& one : each) {
    all.middleRows(first, one.rows()) = one;
    first += one.rows();
  }
  return all;
}

Eigen::MatrixXd model_on_rows(ModelOnStrips const& on, std::vector<SampleTreatment> const& samples) {
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(on.rows(), on.parameters());
  Eigen::Index row = 0;
  for (std::size_t i = 0; i < on.strips().size(); ++i) {
    Strip const& strip = on.strips()[i];
    auto const rows = static_cast<Eigen::Index>(strip.rows.size());
    Eigen::Index column = 0;
    for (auto const& part : on.parts(i)) {
      all.block(row, column, rows, part.count()) = on_rows(strip, part, samples[i].side, samples[i].weight);
      column += part.count();
    }
    if (i > 0) all.block(row, column + static_cast<Eigen::Index>(i) - 1, rows, 1) = on_rows(strip, samples[i].weight);
    row += rows;
  }
  return all;
}

std::vector<SampleTreatment> treated_samples(ModelOnStrips const& on, double late_s, Eigen::VectorXd const& parameters,
                                             Eigen::VectorXd const& sticking) {
  std::vector<SampleTreatment> samples;
  for (std::size_t i = 0; i < on.strips().size(); ++i) {
    Strip const& strip = on.strips()[i];
    SampleTreatment one{Eigen::VectorXd::Ones(strip.size()), strip.direction};
    if (sticking.size() > 0) one.side += (strip.sides.colwise() - strip.direction) * sticking;
    SampleTorque torque{};
    Eigen::VectorXd asked{};
    if (parameters.size() > 0) {
      torque = sample_torque(on, i, parameters);
      asked = earlier(strip.torque, late_s, strip.motion.rate_hz) - torque.smooth;
    }
    for (Eigen::Index k = 0; k < strip.size(); ++k) {
      if (strip.is_quiet[static_cast<std::size_t>(k)] == 0) continue;
      bool const above = asked.size() > 0 && asked[k] > std::max(torque.forward[k], torque.backward[k]);
      bool const below = asked.size() > 0 && asked[k] < std::min(torque.forward[k], torque.backward[k]);
      one.weight[k] = above || below ? 1.0 : 0.0;
      one.side[k] = !above && !below                                     ? strip.direction[k]
                    : above == (torque.forward[k] >= torque.backward[k]) ? 1.0
                                                                         : -1.0;
    }
    samples.push_back(std::move(one));
  }
  return samples;
}

Eigen::VectorXd model_torque(ModelOnStrips const& on, std::size_t strip, SampleTreatment const& samples,
                             Eigen::VectorXd const& parameters) {
  SampleTorque const torque = sample_torque(on, strip, parameters);
  return torque.smooth + 0.5 * ((1.0 + samples.side.array()) * torque.forward.array() +
                                (1.0 - samples.side.array()) * torque.backward.array())
                                   .matrix();
}

Eigen::VectorXd sticking_on_rows(ModelOnStrips const& on, TreatedFit const& fit) {
  return sticking_columns_on_rows(on, fit.samples, fit.parameters) * fit.sticking;
}

TreatedFit treated_fit(ModelOnStrips const& on, double late_s) {
  constexpr int most_rounds = 4;
  TreatedFit fit;
  for (int round = 0; round < most_rounds; ++round) {
    bool const knows = fit.parameters.size() > 0;
    // the sign alone, for the mixture to be fitted beside it
    auto samples = treated_samples(on, late_s, fit.parameters, {});
    fit.torque = torque_on_rows(on, samples, late_s);
    fit.sticking = Eigen::VectorXd::Zero(on.strips().front().sides.cols());
    if (knows)
      fit.sticking = fitted_sticking(model_on_rows(on, samples), sticking_columns_on_rows(on, samples, fit.parameters),
                                     fit.torque);
    samples = treated_samples(on, late_s, fit.parameters, fit.sticking);
    bool const stays = round > 1 && are_same(samples, fit.samples);
    fit.columns = model_on_rows(on, samples);
    fit.parameters = solve_scaled(fit.columns, fit.torque).col(0);
    fit.residual = fit.torque - fit.columns * fit.parameters;
    fit.samples = std::move(samples);
    if (stays) break;
  }
  return fit;
}

}  // namespace torquescope
