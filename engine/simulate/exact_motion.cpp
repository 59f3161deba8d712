#include "engine/simulate/exact_motion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "engine/base/huge_pages.hpp"
#include "engine/simulate/orthogonal_noise.hpp"

namespace torquescope {

namespace {

// samples whose columns are held at one time
constexpr Eigen::Index block_samples = 4096;
constexpr Eigen::Index noise_together = 256;

// columns of every linear parameter
Eigen::MatrixXd columns_of(std::vector<PlantTerm> const& terms, Motion const& motion) {
  Eigen::Index size = 0;
  for (auto const& term : terms) size += static_cast<Eigen::Index>(term.effect->n_linear());
  Eigen::MatrixXd phi(motion.q.size(), size);
  Eigen::Index first = 0;
  for (auto const& term : terms) {
    auto const linear = static_cast<Eigen::Index>(term.effect->n_linear());
    std::span<double const> const values(term.parameters);
    term.effect->columns({motion}, values.subspan(term.effect->n_linear()), phi.middleCols(first, linear));
    first += linear;
  }
  return phi;
}

Eigen::VectorXd linear_parameters(std::vector<PlantTerm> const& terms) {
  std::vector<double> parameters;
  for (auto const& term : terms)
    parameters.insert(parameters.end(), term.parameters.begin(),
                      term.parameters.begin() + static_cast<std::ptrdiff_t>(term.effect->n_linear()));
  return Eigen::Map<Eigen::VectorXd const>(parameters.data(), static_cast<Eigen::Index>(parameters.size()));
}

Motion block_of(Motion const& motion, Eigen::Index first, Eigen::Index count) {
  return {motion.rate_hz,
          motion.time_s.segment(first, count),
          motion.q.segment(first, count),
          motion.dq.segment(first, count),
          motion.ddq.segment(first, count),
          {}};
}

bool has_memory(std::vector<PlantTerm> const& terms) {
  return std::any_of(terms.begin(), terms.end(), [](PlantTerm const& term) { return term.effect->has_memory(); });
}

// block by block, unless an effect remembers what was before
Eigen::VectorXd torque_of(std::vector<PlantTerm> const& terms, Motion const& motion) {
  Eigen::VectorXd const parameters = linear_parameters(terms);
  if (has_memory(terms)) return columns_of(terms, motion) * parameters;
  Eigen::Index const n = motion.q.size();
  Eigen::VectorXd torque(n);
  in_huge_pages(torque);
  for (Eigen::Index first = 0; first < n; first += block_samples) {
    Eigen::Index const count = std::min(block_samples, n - first);
    torque.segment(first, count) = columns_of(terms, block_of(motion, first, count)) * parameters;
  }
  return torque;
}

Motion exact_motion(Reference const& reference, double rate_hz, Eigen::Index samples) {
  Motion motion;
  motion.rate_hz = rate_hz;
  for (auto* channel : {&motion.time_s, &motion.q, &motion.dq, &motion.ddq}) {
    channel->resize(samples);
    in_huge_pages(*channel);
  }
  for (Eigen::Index i = 0; i < samples; ++i) motion.time_s[i] = static_cast<double>(i) / rate_hz;
  auto const numbers = [](Eigen::VectorXd& column) {
    return std::span(column.data(), static_cast<std::size_t>(column.size()));
  };
  reference.at_each(numbers(motion.time_s), {numbers(motion.q), numbers(motion.dq), numbers(motion.ddq)});
  return motion;
}

}  // namespace

void record_exact_motion(SimulationPlan const& plan, Reference const& reference, RandomKey const& key, TrueTorque truth,
                         SimulatedRecording& recording) {
  NoiseOptions const& noise = plan.noise;
  double const rate_hz = plan.simulation.rate_hz;
  Motion motion = exact_motion(reference, rate_hz, plan.simulation.samples());
  recording.has_exact_motion = true;
  recording.true_torque = torque_of(plan.plant, motion);
  bool const validation = key.run > 0, orthogonal = noise.orthogonal_mse > 0.0 && !validation;
  if (orthogonal) recording.torque = orthogonal_noise(columns_of(plan.plant, motion), noise.orthogonal_mse, key);
  recording.time_s = std::move(motion.time_s);
  recording.position = std::move(motion.q);  // reference and true position too (joint_simulation.hpp)
  recording.true_velocity = std::move(motion.dq);
  recording.true_acceleration = std::move(motion.ddq);
  if (orthogonal) {
    recording.torque += recording.true_torque;
    return;
  }
  double const white_std = noise.orthogonal_mse > 0.0 ? std::sqrt(noise.orthogonal_mse) : noise.torque_std;
  ColouredNoise white(key, NoiseStream::torque_white, white_std, 0.0, rate_hz);
  ColouredNoise coloured(key, NoiseStream::torque_coloured, noise.torque_coloured_std, noise.torque_coloured_s,
                         rate_hz);
  // the noise comes on top of it: a copy only for who wants both
  if (truth == TrueTorque::left_out) {
    recording.torque = std::move(recording.true_torque);
    recording.true_torque = Eigen::VectorXd();
  } else {
    recording.torque = recording.true_torque;
  }
  std::array<double, noise_together> of_white, of_coloured;
  for (Eigen::Index first = 0; first < recording.torque.size(); first += noise_together) {
    Eigen::Index const count = std::min<Eigen::Index>(noise_together, recording.torque.size() - first);
    white.next(std::span(of_white).first(static_cast<std::size_t>(count)));
    coloured.next(std::span(of_coloured).first(static_cast<std::size_t>(count)));
    for (Eigen::Index i = 0; i < count; ++i)
      recording.torque[first + i] += of_white[static_cast<std::size_t>(i)] + of_coloured[static_cast<std::size_t>(i)];
  }
}

}  // namespace torquescope
