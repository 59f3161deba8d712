#include "engine/fit/statistics/gram_identifiability.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/base/contract.hpp"
#include "engine/base/dense_solvers.hpp"

namespace torquescope {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

std::vector<Index> seen_columns(MatrixXd const& gram, VectorXd const& plausible) {
  std::vector<Index> seen;
  for (Index j = 0; j < gram.cols(); ++j) {
    double const noises = std::sqrt(std::max(0.0, gram(j, j)));
    if (noises > 0.0 && (plausible.size() == 0 || noises * plausible[j] > 1.0)) seen.push_back(j);
  }
  return seen;
}

// members that share a weak direction, one after the other
std::vector<std::vector<Index>> connected(std::vector<Index> const& members, MatrixXd const& shares) {
  std::vector<std::vector<Index>> groups;
  std::vector<bool> taken(members.size(), false);
  for (std::size_t first = 0; first < members.size(); ++first) {
    if (taken[first]) continue;
    taken[first] = true;
    std::vector<std::size_t> group{first};
    for (std::size_t next = 0; next < group.size(); ++next)
      for (std::size_t other = 0; other < members.size(); ++other) {
        bool const together =
            (shares.row(members[group[next]]).array().min(shares.row(members[other]).array()) > 0.0).any();
        if (taken[other] || !together) continue;
        taken[other] = true;
        group.push_back(other);
      }
    groups.emplace_back();
    for (auto const at : group) groups.back().push_back(members[at]);
    std::sort(groups.back().begin(), groups.back().end());
  }
  return groups;
}

}  // namespace

GramIdentifiability gram_identifiability(MatrixXd const& gram, VectorXd const& plausible) {
  TORQUESCOPE_EXPECT(gram.rows() == gram.cols() && (plausible.size() == 0 || plausible.size() == gram.cols()));
  GramIdentifiability found;
  found.seen.assign(static_cast<std::size_t>(gram.cols()), Seen::not_at_all);
  auto const columns = seen_columns(gram, plausible);
  Index const n = static_cast<Index>(columns.size());
  if (n == 0) return found;
  MatrixXd scaled(n, n);
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < n; ++j) {
      Index const a = columns[static_cast<std::size_t>(i)], b = columns[static_cast<std::size_t>(j)];
      scaled(i, j) = gram(a, b) / std::sqrt(gram(a, a) * gram(b, b));
    }
  auto const axes = symmetric_axes(scaled);
  double const largest = axes.values[n - 1], zero = 1e-15 * static_cast<double>(n) * largest;  // rounding
  // what each direction adds to each variance, over the whole of it; strong directions do not count
  MatrixXd shares(n, n);
  VectorXd weak = VectorXd::Zero(n);
  for (Index k = 0; k < n; ++k) {
    double const eigenvalue = std::max(axes.values[k], zero);
    shares.col(k) = axes.vectors.col(k).cwiseAbs2() / eigenvalue;
    weak[k] = std::sqrt(largest / eigenvalue) > weak_condition_index ? 1.0 : 0.0;
  }
  for (Index j = 0; j < n; ++j) shares.row(j) /= shares.row(j).sum();
  shares = shares * weak.asDiagonal();
  std::vector<Index> members;
  for (Index j = 0; j < n; ++j) {
    bool const shared = shares.row(j).sum() > shared_variance;
    found.seen[static_cast<std::size_t>(columns[static_cast<std::size_t>(j)])] =
        shared ? Seen::in_a_group : Seen::alone;
    if (shared) members.push_back(j);
  }
  // a direction joins those of whose variance it is a tenth of the limit
  found.groups = connected(members, (shares.array() > 0.1 * shared_variance).select(shares, 0.0));
  for (auto& group : found.groups)
    for (auto& member : group) member = columns[static_cast<std::size_t>(member)];
  double const least = axes.values[0];
  found.condition = least > zero ? std::sqrt(largest / least) : std::numeric_limits<double>::infinity();
  return found;
}

}  // namespace torquescope
