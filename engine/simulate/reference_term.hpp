#pragma once
// What a controller may add by looking at its reference alone, and not in proportion to it: friction and gravity fed
// forward.
//
// Equation   smooth_sign  tanh(v / width),  v = (r_(k+ahead) - r_(k+ahead-span)) / span;   sine, cosine  of r_(k+ahead)
// Units      r rad or m; width the same, per sample; the term itself has none, its gain is N m or N
// Ends       beyond them the reference goes on as its odd reflection: a ramp stays a ramp, or a controller would see it
//            stop dead
// Threads    plain records

#include <Eigen/Core>

namespace torquescope {

// reference beyond its ends too; [n], n > 0; a view
class ReferenceSignal {
 public:
  explicit ReferenceSignal(Eigen::VectorXd const& reference) : r_(reference) {}
  double operator()(Eigen::Index k) const;

 private:
  Eigen::VectorXd const& r_;
};

enum class ReferenceShape { smooth_sign, sine, cosine };

struct ReferenceTerm {
  ReferenceShape shape = ReferenceShape::smooth_sign;
  int ahead = 0;
  int span = 1;        // of a smooth sign, in samples
  double width = 1.0;  // of a smooth sign
  double gain = 0.0;   // in a controller

  double operator()(ReferenceSignal const& reference, Eigen::Index k) const;
};

}  // namespace torquescope
