#include "identification_problems.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <memory>
#include <numbers>

#include "engine/base/random_stream.hpp"
#include "engine/effects/effect.hpp"
#include "engine/robot/inverse_dynamics.hpp"
#include "engine/robot/pseudo_inertia.hpp"
#include "engine/simulate/controller.hpp"
#include "engine/simulate/joint_plant.hpp"

namespace torquescope::bench {

namespace {

using Eigen::Index;
constexpr double noise_share = 0.02;

RandomStream stream(std::uint32_t instance, std::uint32_t problem) {
  return {{57, instance, RandomDomain::test}, problem, 0};
}

// from a place in 0 .. 1
struct Range {
  double lower, upper;
  bool is_logarithmic = false;
  double at(double place) const {
    return is_logarithmic ? lower * std::pow(upper / lower, place) : lower + place * (upper - lower);
  }
};

std::vector<double> at(std::vector<Range> const& ranges, std::span<double const> places) {
  std::vector<double> values;
  for (std::size_t j = 0; j < ranges.size(); ++j) values.push_back(ranges[j].at(places[j]));
  return values;
}

std::vector<double> drawn_truth(std::size_t dimension, RandomStream& random) {
  std::vector<double> truth(dimension);
  for (double& place : truth) place = random.uniform(0.2, 0.8);
  return truth;
}

double rms(Eigen::VectorXd const& values) { return values.norm() / std::sqrt(static_cast<double>(values.size())); }

Eigen::VectorXd with_noise(Eigen::VectorXd values, RandomStream& random) {
  double const size = noise_share * rms(values);
  for (double& value : values) value += size * random.normal();
  return values;
}

// sum of three sines, so that position, speed and acceleration are exact
Motion drawn_motion(RandomStream& random, Index n, double rate_hz, double amplitude) {
  Motion motion;
  motion.rate_hz = rate_hz;
  motion.time_s = Eigen::VectorXd::LinSpaced(n, 0.0, static_cast<double>(n - 1) / rate_hz);
  motion.q = motion.dq = motion.ddq = motion.torque = Eigen::VectorXd::Zero(n);
  double const duration = static_cast<double>(n) / rate_hz;
  for (int wave = 1; wave <= 3; ++wave) {
    double const omega = 2.0 * std::numbers::pi * wave / duration, phase = random.uniform(0.0, 2.0 * std::numbers::pi);
    double const size = amplitude * random.uniform(0.5, 1.0) / wave;
    auto const angle = (omega * motion.time_s.array() + phase).eval();
    motion.q.array() += size * angle.sin();
    motion.dq.array() += size * omega * angle.cos();
    motion.ddq.array() -= size * omega * omega * angle.sin();
  }
  return motion;
}

SerialChain two_links() {
  SerialChain chain;
  chain.joints.resize(2);
  chain.joints[1].a = 0.4;
  chain.gravity = {0.0, -9.81, 0.0};
  return chain;
}

// rows of both joints one below the other
struct TwoLinkRows {
  Eigen::MatrixXd phi;  // 20 columns
  Eigen::MatrixXd dq;   // n x 2
};

TwoLinkRows two_link_rows(RandomStream& random) {
  constexpr Index n = 100;
  auto const first = drawn_motion(random, n, 50.0, 1.0), second = drawn_motion(random, n, 50.0, 1.5);
  auto const chain = two_links();
  TwoLinkRows rows{Eigen::MatrixXd(2 * n, 20), Eigen::MatrixXd(n, 2)};
  rows.dq << first.dq, second.dq;
  for (Index i = 0; i < n; ++i) {
    Eigen::Vector2d const q(first.q[i], second.q[i]), dq(first.dq[i], second.dq[i]), ddq(first.ddq[i], second.ddq[i]);
    Eigen::MatrixXd const phi = arm_regressor(chain, q, dq, ddq);
    rows.phi.row(i) = phi.row(0);
    rows.phi.row(n + i) = phi.row(1);
  }
  return rows;
}

double huber_mean(Eigen::VectorXd const& errors, double delta) {
  double sum = 0.0;
  for (double const e : errors) {
    double const size = std::fabs(e);
    sum += size <= delta ? e * e : delta * (2.0 * size - delta);
  }
  return sum / static_cast<double>(errors.size());
}

IdentificationProblem huber(std::uint32_t instance) {
  auto random = stream(instance, 0);
  auto const rows = two_link_rows(random);
  Index const n = rows.dq.rows();
  auto const column = [](int link, LinkNumber number) { return 10 * link + static_cast<Index>(number); };
  std::vector<Index> const kept{column(0, LinkNumber::zz), column(0, LinkNumber::mx), column(0, LinkNumber::my),
                                column(1, LinkNumber::zz), column(1, LinkNumber::mx), column(1, LinkNumber::my)};
  Eigen::MatrixXd phi = Eigen::MatrixXd::Zero(2 * n, 10);
  for (Index j = 0; j < 6; ++j) phi.col(j) = rows.phi.col(kept[static_cast<std::size_t>(j)]);
  for (Index joint = 0; joint < 2; ++joint) {
    phi.col(6 + joint).segment(joint * n, n) = rows.dq.col(joint);
    phi.col(8 + joint).segment(joint * n, n) = rows.dq.col(joint).array().sign().matrix();
  }
  std::vector<Range> const ranges{{0.0, 4.0},  {-2.0, 4.0}, {-2.0, 2.0}, {0.0, 1.0}, {-1.0, 2.0},
                                  {-1.0, 1.0}, {0.0, 5.0},  {0.0, 3.0},  {0.0, 5.0}, {0.0, 3.0}};
  auto const truth = drawn_truth(ranges.size(), random);
  auto const parameters = at(ranges, truth);
  Eigen::VectorXd const exact = phi * Eigen::Map<Eigen::VectorXd const>(parameters.data(), 10);
  Eigen::VectorXd torque = with_noise(exact, random);
  for (double& tau : torque)
    if (random.uniform() < 0.1) tau += rms(exact) * std::fabs(random.normal());
  double const delta = 1.345 * noise_share * rms(exact);
  return {ranges.size(),
          [=](std::span<double const> places) {
            auto const values = at(ranges, places);
            return huber_mean(torque - phi * Eigen::Map<Eigen::VectorXd const>(values.data(), 10), delta);
          },
          truth};
}

std::vector<Range> shapes_of(Effect const& effect, JointScales const& scales) {
  std::vector<Range> ranges;
  for (auto const& range : effect.shape_bounds(scales))
    ranges.push_back({range.lower, range.upper, range.spacing == Spacing::logarithmic});
  return ranges;
}

IdentificationProblem friction(std::uint32_t instance) {
  auto random = stream(instance, 1);
  auto const motion = std::make_shared<Motion>(drawn_motion(random, 400, 100.0, 0.5));
  JointScales scales;
  scales.rate_hz = motion->rate_hz;
  scales.duration_s = 4.0;
  scales.peak_speed = motion->dq.cwiseAbs().maxCoeff();
  scales.position_range = motion->q.maxCoeff() - motion->q.minCoeff();
  scales.coulomb_positive = scales.coulomb_negative = 1.0;
  auto const* stribeck = find_effect("stribeck");
  auto const* presliding = find_effect("presliding");
  // linear ones, then the shapes
  std::vector<Range> ranges{{0.0, 3.0}, {0.0, 2.0}, {0.0, 2.0}, {0.0, 2.0}, {0.0, 2.0}, {-1.0, 1.0}};
  for (auto const& range : shapes_of(*stribeck, scales)) ranges.push_back(range);
  for (auto const& range : shapes_of(*presliding, scales)) ranges.push_back(range);
  auto const torque_of = [=](std::span<double const> places) -> Eigen::VectorXd {
    auto const p = at(ranges, places);
    EffectInput const input{*motion, scales};
    Eigen::MatrixXd fading(motion->q.size(), 1), bending(motion->q.size(), 2);
    stribeck->columns(input, std::span(p).subspan(6, 2), fading);
    presliding->columns(input, std::span(p).subspan(8, 1), bending);
    return p[0] * motion->dq + p[1] * motion->dq.array().sign().matrix() + p[2] * fading.col(0) +
           bending * Eigen::Vector2d(p[3], p[4]) + Eigen::VectorXd::Constant(motion->q.size(), p[5]);
  };
  auto const truth = drawn_truth(ranges.size(), random);
  Eigen::VectorXd const torque = with_noise(torque_of(truth), random);
  return {ranges.size(),
          [=](std::span<double const> places) {
            return (torque - torque_of(places)).squaredNorm() / static_cast<double>(torque.size());
          },
          truth};
}

constexpr double loop_rate_hz = 100.0;

// positions of the joint under its controller
Eigen::VectorXd loop_positions(Motion const& wanted, std::span<double const> p) {
  JointPlant const plant({{find_effect("inertia"), {p[0]}},
                          {find_effect("viscous"), {p[1]}},
                          {find_effect("coulomb"), {p[2]}},
                          {find_effect("stribeck"), {p[3], p[4], p[5]}},
                          {find_effect("gravity"), {p[6], 0.0}}});
  ControllerOptions options;
  options.kind = "pd";
  options.bandwidth_hz = 3.0;
  auto const reference = [&](Index i) { return ReferencePoint{wanted.q[i], wanted.dq[i], wanted.ddq[i]}; };
  // of the inertia that its maker believed in
  Controller controller(options, loop_rate_hz, 0.5, reference(0));
  JointState state{0.0, wanted.q[0], wanted.dq[0], 0.0};
  Eigen::VectorXd positions(wanted.q.size());
  for (Index i = 0; i < wanted.q.size(); ++i) {
    positions[i] = state.q;
    state = plant.advance(state, controller.command(reference(i), state.q), 1.0 / loop_rate_hz);
  }
  return positions;
}

IdentificationProblem loop(std::uint32_t instance) {
  auto random = stream(instance, 2);
  auto const wanted = std::make_shared<Motion>(drawn_motion(random, 200, loop_rate_hz, 0.6));
  std::vector<Range> const ranges{{0.2, 1.0},        {0.0, 3.0}, {0.0, 3.0}, {0.0, 3.0},
                                  {0.01, 1.0, true}, {0.5, 2.0}, {0.0, 8.0}};
  auto const truth = drawn_truth(ranges.size(), random);
  // of the error of tracking, which is all that the parameters show in
  Eigen::VectorXd const measured =
      wanted->q + with_noise(loop_positions(*wanted, at(ranges, truth)) - wanted->q, random);
  return {ranges.size(),
          [=](std::span<double const> places) {
            return (measured - loop_positions(*wanted, at(ranges, places))).squaredNorm() /
                   static_cast<double>(measured.size());
          },
          truth};
}

// lower triangle with a positive diagonal, sizes of a link of some kilograms and decimetres
PseudoInertia body(std::span<double const> p) {
  PseudoInertia factor = PseudoInertia::Zero();
  factor.diagonal() << p[0], p[1], p[2], p[3];
  factor(1, 0) = p[4];
  factor(2, 0) = p[5];
  factor(2, 1) = p[6];
  factor(3, 0) = p[7];
  factor(3, 1) = p[8];
  factor(3, 2) = p[9];
  return factor * factor.transpose();
}

IdentificationProblem bodies(std::uint32_t instance) {
  auto random = stream(instance, 3);
  Eigen::MatrixXd const phi = two_link_rows(random).phi.rightCols(10);
  std::vector<Range> const ranges{{0.02, 0.6, true}, {0.02, 0.6, true}, {0.02, 0.6, true}, {0.5, 3.0, true},
                                  {-0.3, 0.3},       {-0.3, 0.3},       {-0.3, 0.3},       {-2.0, 2.0},
                                  {-2.0, 2.0},       {-2.0, 2.0}};
  auto const truth = drawn_truth(ranges.size(), random);
  Eigen::VectorXd const torque = with_noise(phi * link_vector(body(at(ranges, truth))), random);
  PseudoInertia const prior = body(at(ranges, std::vector<double>(ranges.size(), 0.55)));
  double const floor = std::pow(noise_share * rms(torque), 2);
  return {ranges.size(),
          [=](std::span<double const> places) {
            PseudoInertia const candidate = body(at(ranges, places));
            Eigen::VectorXd const errors = torque - phi * link_vector(candidate);
            return errors.squaredNorm() / static_cast<double>(errors.size()) +
                   1e-2 * floor * divergence(candidate, prior);
          },
          truth};
}

}  // namespace

std::vector<std::string> const& identification_names() {
  static std::vector<std::string> const names{"huber", "friction", "loop", "bodies"};
  return names;
}

IdentificationProblem identification_problem(std::string const& name, std::uint32_t instance) {
  if (name == "huber") return huber(instance);
  if (name == "friction") return friction(instance);
  return name == "loop" ? loop(instance) : bodies(instance);
}

}  // namespace torquescope::bench
