// The same rows and products by libraries: Pinocchio's computeJointTorqueRegressor, its algorithm in plain Eigen, and
// Eigen's rank updates. A program of its own with -march=native; see peers/CMakeLists.txt.
//
// Use        bench_arms ROBOT.toml --describe | bench_arm_peers [--samples N] [--rounds N] prints JSON
// Method     regressor: of every sample, one call. both: rows of 128 samples from it, the standing columns picked, with
//            dq, sign(dq), 1 and the torque, then one rank update a joint. Least of all rounds, thread CPU time

#include <time.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

#include "bench/arms/plain_regressor.hpp"
#ifdef TORQUESCOPE_PINOCCHIO
#include "bench/arms/pinocchio_regressor.hpp"
#endif

namespace peers {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr Index block = 128;

double cpu_seconds() {
  timespec time;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

Arm read_arm(std::istream& in) {
  Arm arm;
  std::size_t n = 0;
  in >> n;
  arm.joints.resize(n);
  for (auto& joint : arm.joints) in >> joint.slides >> joint.a >> joint.alpha >> joint.d >> joint.offset;
  in >> arm.gravity.x() >> arm.gravity.y() >> arm.gravity.z();
  arm.standing.resize(n);
  for (auto& columns : arm.standing) {
    std::size_t count = 0;
    in >> count;
    columns.resize(count);
    for (auto& column : columns) in >> column;
  }
  if (!in || n == 0) std::exit(65);
  return arm;
}

// as signals() of main.cpp: the squares of all rows are then the same
MatrixXd signals(Index n_samples, Index joints, double phase) {
  return MatrixXd::NullaryExpr(joints, n_samples, [&](Index j, Index t) {
    double const angle = phase + 0.37 * static_cast<double>(j) + 1e-2 * static_cast<double>(t % 62'831);
    return angle - 6.0 * static_cast<double>(static_cast<long>(angle / 6.0)) - 3.0;
  });
}

struct Motion {
  MatrixXd q, dq, ddq, tau;  // joints x samples: one column a call
};

template <class Regressor>
double sweep(Regressor& regressor, Motion const& motion) {
  double sum = 0.0;
  for (Index t = 0; t < motion.q.cols(); ++t)
    sum += regressor(motion.q.col(t), motion.dq.col(t), motion.ddq.col(t))(0, 9);
  return sum;
}

template <class Regressor>
std::vector<MatrixXd> products(Regressor& regressor, Arm const& arm, Motion const& motion) {
  auto const n = static_cast<Index>(arm.joints.size());
  std::vector<MatrixXd> grams, rows;
  for (auto const& columns : arm.standing) {
    auto const width = static_cast<Index>(columns.size()) + 4;
    grams.push_back(MatrixXd::Zero(width, width));
    rows.push_back(MatrixXd(width, block));
  }
  for (Index first = 0; first < motion.q.cols(); first += block) {
    Index const count = std::min(block, motion.q.cols() - first);
    for (Index t = 0; t < count; ++t) {
      Index const at = first + t;
      auto const& phi = regressor(motion.q.col(at), motion.dq.col(at), motion.ddq.col(at));
      for (Index j = 0; j < n; ++j) {
        auto const& columns = arm.standing[static_cast<std::size_t>(j)];
        double* out = rows[static_cast<std::size_t>(j)].col(t).data();
        // a drive's column is the acceleration
        for (Index const column : columns) *out++ = column < 10 * n ? phi(j, column) : motion.ddq(j, at);
        double const speed = motion.dq(j, at);
        *out++ = speed;
        *out++ = speed > 0.0 ? 1.0 : speed < 0.0 ? -1.0 : 0.0;
        *out++ = 1.0;
        *out++ = motion.tau(j, at);
      }
    }
    for (std::size_t j = 0; j < grams.size(); ++j)
      grams[j].selfadjointView<Eigen::Upper>().rankUpdate(rows[j].leftCols(count));
  }
  return grams;
}

template <class Regressor>
void measure(char const* name, Regressor regressor, Arm arm, Motion const& motion, int rounds) {
  auto const n_links = static_cast<Index>(10 * arm.joints.size());
  for (auto& columns : arm.standing)
    for (auto& column : columns)
      if (column < n_links) column = Regressor::place(column);
  double alone = 1e9, both = 1e9, sum = 0.0;
  std::vector<MatrixXd> grams;
  for (int round = 0; round < rounds; ++round) {
    double begin = cpu_seconds();
    sum += sweep(regressor, motion);
    alone = std::min(alone, cpu_seconds() - begin);
    begin = cpu_seconds();
    grams = products(regressor, arm, motion);
    both = std::min(both, cpu_seconds() - begin);
  }
  double const each = 1e9 / static_cast<double>(motion.q.cols());
  double squares = 0.0;
  for (auto const& gram : grams) squares += gram.trace();
  std::printf("{\"peer\": \"%s\", \"regressor_ns\": %.1f, \"both_ns\": %.1f, \"squares\": %.17g, \"sum\": %.3g}\n",
              name, each * alone, each * both, squares, sum);
}

}  // namespace
}  // namespace peers

int main(int argc, char** argv) {
  using namespace peers;
  Index n_samples = 20'000;
  int rounds = 5;
  for (int i = 1; i + 1 < argc; i += 2) {
    std::string const word = argv[i];
    if (word == "--samples") n_samples = std::atol(argv[i + 1]);
    if (word == "--rounds") rounds = std::atoi(argv[i + 1]);
  }
  Arm const arm = read_arm(std::cin);
  auto const n = static_cast<Index>(arm.joints.size());
  Motion const motion{signals(n_samples, n, 0.1), signals(n_samples, n, 0.7), signals(n_samples, n, 1.3),
                      signals(n_samples, n, 2.9)};
  measure("plain Eigen", PlainRegressor(arm), arm, motion, rounds);
#ifdef TORQUESCOPE_PINOCCHIO
  measure("Pinocchio " PINOCCHIO_VERSION, PinocchioRegressor(arm), arm, motion, rounds);
#endif
  return 0;
}
