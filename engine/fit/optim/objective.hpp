#pragma once
// What an optimiser may know of a problem: a bounded vector and a batch evaluator. Smaller fitness is better.
//
// Shapes     candidates: members x dimension, row-major; fitness: one number per member
// Errors     none: a candidate without finite fitness gets NaN or inf, which every optimiser counts as worst
// Threads    const objects, shared; one Workspace per thread

#include <cstddef>
#include <span>
#include <vector>

#include "engine/base/matrix_view.hpp"
#include "kernels/aligned_doubles.hpp"

namespace torquescope {

struct Bounds {
  std::vector<double> lower;  // finite, lower < upper
  std::vector<double> upper;
  std::size_t dimension() const { return lower.size(); }
};

// buffers of one thread, grown once and reused; each objective lays out its own. On cache lines: kernels are
// up to 7 % slower when their sums lie across two of them
struct Workspace {
  kernels::AlignedDoubles numbers;
  kernels::AlignedFloats singles;
};

class Objective {
 public:
  virtual ~Objective() = default;
  virtual Bounds const& bounds() const = 0;
  std::size_t dimension() const { return bounds().dimension(); }
  // what one call of evaluate() reads from beginning to end, however many candidates it has: the recording; 0 for none
  virtual std::size_t bytes_swept() const { return 0; }
  virtual void evaluate(MatrixView<double const> candidates, std::span<double> fitness, Workspace& workspace) const = 0;
};

}  // namespace torquescope
