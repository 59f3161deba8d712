#pragma once
// What fits that leave a stretch of rows out leave inside it, in closed form: for many signals and candidates at once.
//
// Equation   Q orthonormal on all rows. Fit without the rows G: b = (I - Q_G' Q_G + r I)^-1 (Q' y - Q_G' y_G);
//            left inside it: |y_F - Q_F b|^2, F the fold without its guard. r = left_out_ridge: a direction that only
//            the left-out rows hold is predicted as nothing
// Folds      whole: ten equal stretches. interleaved: stretches as short as the guard, every tenth left out together,
//            for effects that act in one stretch of the record
// Shapes     n rows, m signals; products: k x m for the k columns of a basis
// Threads    const object
// Source     Hoaglin, Welsch 1978, doi:10.1080/00031305.1978.10479237 (downdate); Burman, Chow, Nolan 1994,
//            doi:10.1093/biomet/81.2.351 (blocks with a guard)

#include <Eigen/Core>
#include <vector>

#include "engine/fit/statistics/equal_blocks.hpp"

namespace torquescope {

// share of a column's energy outside a fold below which a fit cannot see it
inline constexpr double left_out_ridge = 1e-4;

enum class FoldKind { whole, interleaved };

struct Fold {
  std::vector<RowBlock> inside{};  // rows that are predicted
  std::vector<RowBlock> guard{};   // rows beside them that no fit of this fold sees either
};

// guard: rows that the filter couples
std::vector<Fold> folds(Eigen::Index n_rows, Eigen::Index guard, FoldKind kind);

// of an orthonormal basis with signals, one for each fold: inside it, and with its guard
struct FoldProducts {
  std::vector<Eigen::MatrixXd> inside{}, left_out{};  // k x m
  Eigen::MatrixXd whole{};                            // k x m: of all rows
};

// Columns with the rows of each fold together, and those of its guard: what products with many others read in one go
struct FoldedRows {
  Eigen::MatrixXd rows{};                   // at most 3 n
  std::vector<RowBlock> inside{}, guard{};  // of `rows`, one for each fold
};

FoldedRows folded_rows(std::vector<Fold> const& folds, Eigen::Ref<Eigen::MatrixXd const> const& columns);

FoldProducts fold_products(FoldedRows const& basis, FoldedRows const& signals);
FoldProducts fold_products(std::vector<Fold> const& folds, Eigen::Ref<Eigen::MatrixXd const> const& basis,
                           Eigen::Ref<Eigen::MatrixXd const> const& signals);

// one basis above the other
FoldProducts stacked(FoldProducts const& above, FoldProducts const& below);

// of one basis with further signals
FoldProducts side_by_side(FoldProducts const& left, FoldProducts const& right);

// a block of them
FoldProducts picked(FoldProducts const& products, Eigen::Index first_row, Eigen::Index rows, Eigen::Index first_column,
                    Eigen::Index columns);

// of two bases side by side with themselves; cross: of the second with the first
FoldProducts gram_of(FoldProducts const& first, FoldProducts const& cross, FoldProducts const& second);

// energies inside each fold; folds x m
Eigen::MatrixXd fold_energies(std::vector<Fold> const& folds, Eigen::Ref<Eigen::MatrixXd const> const& signals);

// What is left inside each fold, less the signals' own energy there: folds x m. gram: products of the basis with itself
Eigen::MatrixXd left_inside_less_own(FoldProducts const& gram, FoldProducts const& products);

// what is left of one signal inside the folds, row by row. products: of the basis with that signal
Eigen::VectorXd left_on_rows(std::vector<Fold> const& folds, Eigen::Ref<Eigen::MatrixXd const> const& basis,
                             Eigen::Ref<Eigen::VectorXd const> const& signal, FoldProducts const& gram,
                             FoldProducts const& products);

}  // namespace torquescope
