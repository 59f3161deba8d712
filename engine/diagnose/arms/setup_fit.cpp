#include "engine/diagnose/arms/setup_fit.hpp"

#include <algorithm>
#include <cmath>

#include "engine/base/dense_solvers.hpp"
#include "engine/diagnose/arms/gram_fit.hpp"

namespace torquescope {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index time_blocks = 8;  // of time, fitted and held out in turn

// products of every joint's columns over the even or the odd blocks
std::vector<JointGram> grams_of(ArmRows const& rows, ArmSamples const& samples, Index side) {
  Index const n = samples.size();
  MatrixXd weights = samples.moves;
  for (Index k = 0; k < n; ++k)
    if (k * time_blocks / n % 2 != side) weights.row(k).setZero();
  auto const span_of = [n](MatrixXd const& of, Index j) {
    return std::span<double const>(of.col(j).data(), static_cast<std::size_t>(n));
  };
  std::vector<JointSamples> joints;
  for (Index j = 0; j < samples.q.cols(); ++j)
    joints.push_back({span_of(samples.q, j), span_of(samples.dq, j), span_of(samples.ddq, j), span_of(samples.tau, j),
                      span_of(weights, j)});
  return joint_grams(rows, joints, 1);
}

// of one joint with known base parameters: its error, and the factor of its torque that lowers it most. links: how many
// of the standard columns are theirs
struct FileFit {
  double error, scale;
};

FileFit file_fit(JointGram const& gram, std::vector<ArmColumn> const& columns, BaseParameters const& base,
                 VectorXd const& values, Index links) {
  auto const n = static_cast<Index>(columns.size());
  std::vector<Index> open;
  VectorXd known = VectorXd::Zero(n + 1);
  for (Index k = 0; k < n; ++k) {
    auto const& column = columns[static_cast<std::size_t>(k)];
    bool const is_open = column.base == ArmColumn::of_the_joint ||
                         base.parameters()[static_cast<std::size_t>(column.base)].column >= links;
    if (is_open)
      open.push_back(k);
    else
      known[k] = values[column.base];
  }
  // what the open columns leave of the torque and of what the file predicts
  VectorXd torque = VectorXd::Unit(n + 1, n), predicted = known;
  auto const m = static_cast<Index>(open.size());
  MatrixXd square(m, m), right(m, 2);
  for (Index a = 0; a < m; ++a) {
    Index const row = open[static_cast<std::size_t>(a)];
    for (Index b = 0; b < m; ++b) square(a, b) = gram.products(row, open[static_cast<std::size_t>(b)]);
    right.row(a) << gram.products.row(row).dot(torque), gram.products.row(row).dot(predicted);
  }
  MatrixXd const shares = solve_semidefinite(square, right);
  for (Index a = 0; a < m; ++a) {
    torque[open[static_cast<std::size_t>(a)]] -= shares(a, 0);
    predicted[open[static_cast<std::size_t>(a)]] -= shares(a, 1);
  }
  double const of_torque = square_of(gram, torque), of_file = square_of(gram, predicted);
  double const both = gram.count > 0 ? torque.dot(gram.products * predicted) / static_cast<double>(gram.count) : 0.0;
  double const left = of_torque - 2.0 * both + of_file;
  return {std::sqrt(std::max(left, 0.0) / std::max(torque_square(gram), 1e-300)), of_file / both};
}

void compare_with_file(SetupFit& fit, ArmRows const& rows, BaseParameters const& base, SerialChain const& chain,
                       std::vector<JointGram> const (&sides)[2]) {
  VectorXd const values = base.from_standard(standard_parameters(chain, DriveInertias::included));
  Index const joints = rows.joints();
  fit.file_error.resize(joints);
  fit.file_scale.resize(joints);
  for (Index j = 0; j < joints; ++j) {
    JointGram whole = sides[0][static_cast<std::size_t>(j)];
    add_gram(whole, sides[1][static_cast<std::size_t>(j)]);
    FileFit const of_joint = file_fit(whole, rows.columns(j), base, values, numbers_per_link * chain.size());
    fit.file_error[j] = of_joint.error;
    fit.file_scale[j] = of_joint.scale;
  }
  fit.file_score = fit.file_error.array().max(SetupFit::floor).log().sum();
}

VectorXd own_error(std::vector<JointGram> const (&sides)[2], GramUnknowns const& unknowns) {
  std::vector<JointGram> whole = sides[0];
  for (std::size_t j = 0; j < whole.size(); ++j) add_gram(whole[j], sides[1][j]);
  VectorXd const values = fitted(whole, unknowns);
  VectorXd errors(static_cast<Index>(whole.size()));
  for (Index j = 0; j < errors.size(); ++j) {
    auto const& gram = whole[static_cast<std::size_t>(j)];
    errors[j] = std::sqrt(square_of(gram, direction_of(unknowns, values, j)) / std::max(torque_square(gram), 1e-300));
  }
  return errors;
}

}  // namespace

SetupFit fit_of(ArmSamples const& samples, ArmSetup const& setup, BaseParameters const& base,
                std::optional<Index> free_scale) {
  ArmSamples const taken = taken_as(samples, setup);
  Index const joints = taken.q.cols();
  std::vector<FrictionColumns> const friction(static_cast<std::size_t>(joints));
  ArmRows const rows(setup.chain, base, friction);
  GramUnknowns const unknowns = gram_unknowns(rows, base.size(), free_scale);
  std::vector<JointGram> const sides[] = {grams_of(rows, taken, 0), grams_of(rows, taken, 1)};
  SetupFit fit;
  VectorXd squares = VectorXd::Zero(joints), of_torque = VectorXd::Zero(joints);
  for (int side = 0; side < 2; ++side) {
    VectorXd const values = fitted(sides[side], unknowns);
    fit.scale = free_scale ? values[unknowns.count] : 1.0;
    fit.parameters = values.head(base.size());
    for (Index j = 0; j < joints; ++j) {
      auto const& held_out = sides[1 - side][static_cast<std::size_t>(j)];
      double const factor = free_scale == j ? fit.scale : 1.0;
      squares[j] += square_of(held_out, direction_of(unknowns, values, j));
      of_torque[j] += factor * factor * torque_square(held_out);
    }
  }
  fit.error = (squares.array() / of_torque.array().max(1e-300)).sqrt();
  fit.own_error = own_error(sides, unknowns);
  fit.score = fit.error.array().max(SetupFit::floor).log().sum();
  if (setup.chain.has_inertias()) compare_with_file(fit, rows, base, setup.chain, sides);
  return fit;
}

}  // namespace torquescope
