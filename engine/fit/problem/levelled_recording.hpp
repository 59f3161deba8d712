#pragma once
// A recording packed for the search, its samples sorted by the columns that take few values (Coulomb friction per
// direction, offset): kernels/levelled_energy.hpp. The seed's regressor has two such columns out of four.
//
// Found      columns of at most 3 different values, at least two of them (one saves nothing), whose values
//            come in at most 8 combinations; filtered columns have more values and are not found
// Order      combinations as they appear in the recording; samples of a combination in their order
// Shapes     phi: n x R, tau: n
// Threads    immutable once made; tiles() points into this object

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "kernels/aligned_doubles.hpp"
#include "kernels/levelled_energy.hpp"

namespace torquescope {

class LevelledRecording {
 public:
  // empty when the recording has no such columns, or is too short for runs of tiles
  static std::optional<LevelledRecording> make(Eigen::MatrixXd const& phi, Eigen::VectorXd const& tau);

  kernels::LevelledTiles tiles() const;
  // of all tiles
  std::size_t bytes() const { return (varying_.size() + rest_.size()) * sizeof(double); }

 private:
  LevelledRecording() = default;

  std::vector<std::size_t> constant_column_, varying_column_;
  std::vector<double> level_;         // [run][constant]
  std::vector<std::size_t> run_end_;  // [run] in tiles
  kernels::AlignedDoubles varying_, rest_;
  std::size_t rest_samples_ = 0;
};

}  // namespace torquescope
