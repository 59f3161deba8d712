// Rows of an arm and their products: ns per sample of one thread, in turns with the multiply-add peak of that thread.
//
// Use        bench_arms ROBOT.toml [--samples N] [--rounds N] prints JSON; --describe prints what peers.cpp reads
// Method     every round times each piece once by thread CPU time; the least of all rounds stands
// Counts     products: every pair once. Rows: 25 multiply-adds for the seven usual columns of a link behind the joint
//            and 20 to carry a screw there; what is left of them (sines, outward pass, own links) counts for nothing

#include <sys/resource.h>

#include <algorithm>
#include <bit>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "bench/kernels/fma_peak.hpp"
#include "engine/robot/arm_grams.hpp"
#include "engine/robot/robot_registry.hpp"
#include "kernels/aligned_doubles.hpp"
#include "kernels/joint_grams.hpp"

namespace torquescope::bench {
namespace {

using Eigen::Index;

struct Plan {
  std::string robot;
  Index n_samples = 20'000;
  int rounds = 15;
  bool describe = false;
};

Plan parse(int argc, char** argv) {
  Plan plan;
  for (int i = 1; i < argc; ++i) {
    std::string const word = argv[i];
    if (word == "--describe")
      plan.describe = true;
    else if (word == "--samples" && i + 1 < argc)
      plan.n_samples = std::atol(argv[++i]);
    else if (word == "--rounds" && i + 1 < argc)
      plan.rounds = std::atoi(argv[++i]);
    else
      plan.robot = word;
  }
  return plan;
}

// numbers alone: joints; kind a alpha d offset of each; gravity; standing standard columns of each joint's row
void describe(SerialChain const& chain, BaseParameters const& base, ArmRows const& rows) {
  std::printf("%td\n", chain.size());
  for (auto const& joint : chain.joints)
    std::printf("%d %.17g %.17g %.17g %.17g\n", joint.kind == JointKind::prismatic ? 1 : 0, joint.a, joint.alpha,
                joint.d, joint.offset);
  std::printf("%.17g %.17g %.17g\n", chain.gravity.x(), chain.gravity.y(), chain.gravity.z());
  for (Index joint = 0; joint < rows.joints(); ++joint) {
    std::vector<Index> standing;
    for (auto const& column : rows.columns(joint))
      if (column.base != ArmColumn::of_the_joint)
        standing.push_back(base.columns()[static_cast<std::size_t>(column.base)]);
    std::printf("%zu", standing.size());
    for (auto const column : standing) std::printf(" %td", column);
    std::printf("\n");
  }
}

// smooth enough to be a motion, never twice the same
Eigen::MatrixXd signals(Index n_samples, Index joints, double phase) {
  return Eigen::MatrixXd::NullaryExpr(n_samples, joints, [&](Index t, Index j) {
    double const angle = phase + 0.37 * static_cast<double>(j) + 1e-2 * static_cast<double>(t % 62'831);
    return angle - 6.0 * static_cast<double>(static_cast<long>(angle / 6.0)) - 3.0;
  });
}

double pairs_of(ArmRows const& rows) {
  return static_cast<double>(kernels::pairs_before(rows.plan(), rows.plan().size()));
}

double row_multiply_adds(kernels::ArmPlan const& plan) {
  double count = 0.0;
  for (std::size_t link = 1; link < plan.size(); ++link) {
    auto const columns = static_cast<double>(std::popcount(static_cast<unsigned>(plan.joints()[link].link_columns)));
    count += static_cast<double>(link) * (20.0 + 25.0 / 7.0 * columns);
  }
  return count;
}

double peak_kilobytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss);
}

class Timer {
 public:
  explicit Timer(std::function<void()> call) : call_(std::move(call)) {}
  void once() {
    double const begin = thread_cpu_seconds();
    call_();
    least_ = std::min(least_, thread_cpu_seconds() - begin);
  }
  double least() const { return least_; }

 private:
  std::function<void()> call_;
  double least_ = std::numeric_limits<double>::infinity();
};

void measure(ArmRows const& rows, Plan const& wanted) {
  Index const n = wanted.n_samples, joints = rows.joints();
  auto const q = signals(n, joints, 0.1), dq = signals(n, joints, 0.7), ddq = signals(n, joints, 1.3),
             tau = signals(n, joints, 2.9);
  std::vector<JointSamples> samples;
  auto const column = [n](Eigen::MatrixXd const& matrix, Index j) {
    return std::span<double const>(matrix.data() + j * n, static_cast<std::size_t>(n));
  };
  for (Index j = 0; j < joints; ++j) samples.push_back({column(q, j), column(dq, j), column(ddq, j), column(tau, j)});
  double const before = peak_kilobytes();

  auto const& plan = rows.plan();
  auto const channels = signals_of(samples);
  kernels::AlignedDoubles block(plan.rows_before(plan.size()));
  kernels::AlignedDoubles workspace(kernels::arm_rows_workspace_size(plan));
  kernels::AlignedDoubles lanes(kernels::pairs_before(plan, plan.size()) * kernels::n_lanes);
  auto const n_all = static_cast<std::size_t>(n), n_block = kernels::row_block_samples;
  Timer only_rows([&] {
    for (std::size_t first = 0; first < n_all; first += n_block)
      kernels::arm_rows(plan, channels.data(), first, std::min(n_block, n_all - first), block.data(), workspace.data());
  });
  Timer only_products([&] {
    for (std::size_t first = 0; first < n_all; first += n_block)
      for (std::size_t j = 0; j < plan.size(); ++j)
        kernels::add_products(block.data() + plan.rows_before(j), plan.row_width(j), n_block / kernels::n_lanes,
                              lanes.data() + kernels::pairs_before(plan, j) * kernels::n_lanes);
  });
  double squares = 0.0;
  Timer both([&] {
    squares = 0.0;
    for (auto const& gram : joint_grams(rows, samples, 1)) squares += gram.products.trace();
  });
  double peak = 0.0;
  for (int round = 0; round < wanted.rounds; ++round) {
    only_rows.once();
    only_products.once();
    both.once();
    FmaRate rate;
    rate.measure_for(0.002);
    peak = std::max(peak, rate.per_second());
  }

  double const each = 1e9 / static_cast<double>(n), ideal = 1e9 / peak;
  double const of_rows = row_multiply_adds(plan), of_products = pairs_of(rows);
  std::printf(
      "{\"joints\": %td, \"samples\": %td, \"rows_ns\": %.3f, \"products_ns\": %.3f, \"both_ns\": %.3f, "
      "\"peak_gflops\": %.2f, \"products_percent\": %.1f, \"both_percent\": %.1f, \"pairs\": %.0f, "
      "\"row_multiply_adds\": %.0f, \"more_kilobytes\": %.0f, \"squares\": %.17g}\n",
      joints, n, each * only_rows.least(), each * only_products.least(), each * both.least(), 2e-9 * peak,
      100 * of_products * ideal / (each * only_products.least()),
      100 * (of_products + of_rows) * ideal / (each * both.least()), of_products, of_rows, peak_kilobytes() - before,
      squares);
}

}  // namespace
}  // namespace torquescope::bench

int main(int argc, char** argv) {
  using namespace torquescope;
  auto const plan = bench::parse(argc, argv);
  auto const chain = read_robot(plan.robot);
  BaseParameters const base(chain, DriveInertias::included);
  ArmRows const rows(chain, base, std::vector<FrictionColumns>(chain.joints.size()));
  if (plan.describe)
    bench::describe(chain, base, rows);
  else
    bench::measure(rows, plan);
  return 0;
}
