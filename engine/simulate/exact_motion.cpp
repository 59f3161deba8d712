#include "engine/simulate/exact_motion.hpp"

#include <cmath>

#include "engine/simulate/orthogonal_noise.hpp"

namespace torquescope {

namespace {

struct LinearModel {
  Eigen::MatrixXd phi;
  Eigen::VectorXd parameters;
};

LinearModel linear_model(std::vector<PlantTerm> const& terms, Motion const& motion) {
  Eigen::Index size = 0;
  for (auto const& term : terms) size += static_cast<Eigen::Index>(term.effect->n_linear());

  LinearModel model{Eigen::MatrixXd(motion.q.size(), size), Eigen::VectorXd(size)};
  Eigen::Index first = 0;
  for (auto const& term : terms) {
    auto const linear = static_cast<Eigen::Index>(term.effect->n_linear());
    std::span<double const> const values(term.parameters);
    auto const shape = values.subspan(term.effect->n_linear());
    term.effect->columns({motion}, shape, model.phi.middleCols(first, linear));
    for (Eigen::Index i = 0; i < linear; ++i) model.parameters[first + i] = values[static_cast<std::size_t>(i)];
    first += linear;
  }
  return model;
}

Motion exact_motion(Reference const& reference, double rate_hz, Eigen::Index samples) {
  Motion motion;
  motion.rate_hz = rate_hz;
  for (auto* channel : {&motion.time_s, &motion.q, &motion.dq, &motion.ddq, &motion.torque}) channel->setZero(samples);
  for (Eigen::Index i = 0; i < samples; ++i) {
    motion.time_s[i] = static_cast<double>(i) / rate_hz;
    ReferencePoint const point = reference.at(motion.time_s[i]);
    motion.q[i] = point.q;
    motion.dq[i] = point.dq;
    motion.ddq[i] = point.ddq;
  }
  return motion;
}

}  // namespace

void record_exact_motion(SimulationPlan const& plan, Reference const& reference, RandomKey const& key,
                         SimulatedRecording& recording) {
  NoiseOptions const& noise = plan.noise;
  double const rate_hz = plan.simulation.rate_hz;
  Motion const motion = exact_motion(reference, rate_hz, plan.simulation.samples());
  LinearModel const model = linear_model(plan.plant, motion);

  recording.has_exact_motion = true;
  recording.time_s = motion.time_s;
  recording.reference = recording.position = recording.true_position = motion.q;
  recording.true_velocity = motion.dq;
  recording.true_acceleration = motion.ddq;
  recording.true_torque = model.phi * model.parameters;

  bool const unseen = key.run > 0;
  if (noise.orthogonal_mse > 0.0 && !unseen) {
    recording.torque = recording.true_torque + orthogonal_noise(model.phi, noise.orthogonal_mse, key);
    return;
  }
  double const white_std = noise.orthogonal_mse > 0.0 ? std::sqrt(noise.orthogonal_mse) : noise.torque_std;
  ColouredNoise white(key, NoiseStream::torque_white, white_std, 0.0, rate_hz);
  ColouredNoise coloured(key, NoiseStream::torque_coloured, noise.torque_coloured_std, noise.torque_coloured_s,
                         rate_hz);
  recording.torque = recording.true_torque;
  for (double& torque : recording.torque) torque += white.next() + coloured.next();
}

}  // namespace torquescope
