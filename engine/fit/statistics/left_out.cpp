#include "engine/fit/statistics/left_out.hpp"

#include <algorithm>

#include "engine/base/contract.hpp"
#include "engine/base/dense_solvers.hpp"
#include "engine/fit/statistics/bounded_projection.hpp"

namespace torquescope {
namespace {

std::vector<Fold> whole_folds(Eigen::Index n, Eigen::Index guard) {
  std::vector<Fold> result;
  for (auto const& block : equal_blocks(n, n_folds)) {
    Fold fold{{block}, {}};
    Eigen::Index const from = std::max<Eigen::Index>(0, block.from - guard), to = std::min(n, block.to + guard);
    if (from < block.from) fold.guard.push_back({from, block.from});
    if (block.to < to) fold.guard.push_back({block.to, to});
    result.push_back(std::move(fold));
  }
  return result;
}

std::vector<Fold> interleaved_folds(Eigen::Index n, Eigen::Index guard) {
  Eigen::Index const count = std::max<Eigen::Index>(n / std::max<Eigen::Index>(1, guard), n_folds);
  auto const blocks = equal_blocks(n, count);
  std::vector<Fold> result(static_cast<std::size_t>(n_folds));
  for (Eigen::Index b = 0; b < count; ++b) {
    auto& fold = result[static_cast<std::size_t>(b % n_folds)];
    auto const& block = blocks[static_cast<std::size_t>(b)];
    fold.inside.push_back(block);
    Eigen::Index const from = std::max<Eigen::Index>(0, block.from - guard), to = std::min(n, block.to + guard);
    if (from < block.from) fold.guard.push_back({from, block.from});
    if (block.to < to) fold.guard.push_back({block.to, to});
  }
  return result;
}

Eigen::MatrixXd one_above(Eigen::MatrixXd const& above, Eigen::MatrixXd const& below) {
  Eigen::MatrixXd both(above.rows() + below.rows(), above.cols());
  both << above, below;
  return both;
}

Eigen::MatrixXd one_beside(Eigen::MatrixXd const& left, Eigen::MatrixXd const& right) {
  Eigen::MatrixXd both(left.rows(), left.cols() + right.cols());
  both << left, right;
  return both;
}

using Joining = Eigen::MatrixXd (&)(Eigen::MatrixXd const&, Eigen::MatrixXd const&);

FoldProducts joined(FoldProducts const& one, FoldProducts const& other, Joining join) {
  FoldProducts result;
  for (std::size_t f = 0; f < one.inside.size(); ++f) {
    result.inside.push_back(join(one.inside[f], other.inside[f]));
    result.left_out.push_back(join(one.left_out[f], other.left_out[f]));
  }
  result.whole = join(one.whole, other.whole);
  return result;
}

}  // namespace

std::vector<Fold> folds(Eigen::Index n_rows, Eigen::Index guard, FoldKind kind) {
  TORQUESCOPE_EXPECT(n_rows >= n_folds);
  return kind == FoldKind::whole ? whole_folds(n_rows, guard) : interleaved_folds(n_rows, guard);
}

FoldedRows folded_rows(std::vector<Fold> const& folds, Eigen::Ref<Eigen::MatrixXd const> const& columns) {
  FoldedRows result;
  Eigen::Index n = 0;
  auto const place = [&](std::vector<RowBlock> const& blocks) {
    RowBlock placed{n, n};
    for (auto const& block : blocks) placed.to += block.size();
    n = placed.to;
    return placed;
  };
  for (auto const& fold : folds) {
    result.inside.push_back(place(fold.inside));
    result.guard.push_back(place(fold.guard));
  }
  result.rows.resize(n, columns.cols());
  for (Eigen::Index k = 0; k < columns.cols(); ++k) {
    double* to = result.rows.col(k).data();
    for (auto const& fold : folds)
      for (auto const* blocks : {&fold.inside, &fold.guard})
        for (auto const& block : *blocks) to = std::copy_n(columns.col(k).data() + block.from, block.size(), to);
  }
  return result;
}

FoldProducts fold_products(FoldedRows const& basis, FoldedRows const& signals) {
  auto const of = [&](RowBlock const& rows) { return inner_products(basis.rows, signals.rows, rows); };
  FoldProducts result;
  result.whole = Eigen::MatrixXd::Zero(basis.rows.cols(), signals.rows.cols());
  for (std::size_t f = 0; f < basis.inside.size(); ++f) {
    result.inside.push_back(of(basis.inside[f]));
    result.left_out.push_back(result.inside.back() + of(basis.guard[f]));
    result.whole += result.inside.back();
  }
  return result;
}

FoldProducts fold_products(std::vector<Fold> const& folds, Eigen::Ref<Eigen::MatrixXd const> const& basis,
                           Eigen::Ref<Eigen::MatrixXd const> const& signals) {
  return fold_products(folded_rows(folds, basis), folded_rows(folds, signals));
}

FoldProducts stacked(FoldProducts const& above, FoldProducts const& below) { return joined(above, below, one_above); }

FoldProducts side_by_side(FoldProducts const& left, FoldProducts const& right) {
  return joined(left, right, one_beside);
}

FoldProducts picked(FoldProducts const& products, Eigen::Index first_row, Eigen::Index rows, Eigen::Index first_column,
                    Eigen::Index columns) {
  FoldProducts result;
  for (std::size_t f = 0; f < products.inside.size(); ++f) {
    result.inside.push_back(products.inside[f].block(first_row, first_column, rows, columns));
    result.left_out.push_back(products.left_out[f].block(first_row, first_column, rows, columns));
  }
  result.whole = products.whole.block(first_row, first_column, rows, columns);
  return result;
}

FoldProducts gram_of(FoldProducts const& first, FoldProducts const& cross, FoldProducts const& second) {
  auto const put = [](Eigen::MatrixXd const& a, Eigen::MatrixXd const& c, Eigen::MatrixXd const& b) {
    Eigen::MatrixXd all(a.rows() + b.rows(), a.rows() + b.rows());
    all << a, c.transpose(), c, b;
    return all;
  };
  FoldProducts result;
  for (std::size_t f = 0; f < first.inside.size(); ++f) {
    result.inside.push_back(put(first.inside[f], cross.inside[f], second.inside[f]));
    result.left_out.push_back(put(first.left_out[f], cross.left_out[f], second.left_out[f]));
  }
  result.whole = put(first.whole, cross.whole, second.whole);
  return result;
}

Eigen::MatrixXd fold_energies(std::vector<Fold> const& folds, Eigen::Ref<Eigen::MatrixXd const> const& signals) {
  Eigen::MatrixXd energies = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(folds.size()), signals.cols());
  for (std::size_t f = 0; f < folds.size(); ++f)
    for (auto const& block : folds[f].inside)
      energies.row(static_cast<Eigen::Index>(f)) +=
          signals.middleRows(block.from, block.size()).colwise().squaredNorm();
  return energies;
}

namespace {

// of the fit without fold f
Eigen::MatrixXd fit_without(std::size_t f, FoldProducts const& gram, FoldProducts const& products) {
  Eigen::Index const k = products.whole.rows();
  Eigen::MatrixXd const seen = (1.0 + left_out_ridge) * Eigen::MatrixXd::Identity(k, k) - gram.left_out[f];
  return solve_positive(seen, Eigen::MatrixXd(products.whole - products.left_out[f]));
}

}  // namespace

Eigen::VectorXd left_on_rows(std::vector<Fold> const& folds, Eigen::Ref<Eigen::MatrixXd const> const& basis,
                             Eigen::Ref<Eigen::VectorXd const> const& signal, FoldProducts const& gram,
                             FoldProducts const& products) {
  Eigen::VectorXd left = signal;
  for (std::size_t f = 0; f < folds.size(); ++f) {
    Eigen::VectorXd const fit = fit_without(f, gram, products);
    for (auto const& block : folds[f].inside)
      left.segment(block.from, block.size()) -= basis.middleRows(block.from, block.size()) * fit;
  }
  return left;
}

Eigen::MatrixXd left_inside_less_own(FoldProducts const& gram, FoldProducts const& products) {
  Eigen::MatrixXd change(static_cast<Eigen::Index>(products.inside.size()), products.whole.cols());
  for (std::size_t f = 0; f < products.inside.size(); ++f) {
    Eigen::MatrixXd const fit = fit_without(f, gram, products);
    change.row(static_cast<Eigen::Index>(f)) =
        (fit.array() * (gram.inside[f] * fit - 2.0 * products.inside[f]).array()).colwise().sum();
  }
  return change;
}

}  // namespace torquescope
