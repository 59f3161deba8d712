#include "kernels/arm_rows.hpp"

#include <algorithm>
#include <bit>
#include <utility>

#include "kernels/dispatch-inl.hpp"
#include "kernels/elementary.hpp"

// the part up to HWY_ONCE is compiled once per instruction set
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/arm_rows.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"
#include "kernels/fused-inl.hpp"

#ifndef TORQUESCOPE_KERNELS_ARM_ROWS_BLOCK
#define TORQUESCOPE_KERNELS_ARM_ROWS_BLOCK
namespace torquescope::kernels {

// what a joint brings to the rows, samples in sequence
enum Channel : std::size_t { cosine, sine, distance, speed, push, torque, weight, n_channels };

struct RowBlock {
  ArmPlan const* plan;
  std::size_t n_groups;
  double const* channels;  // [joint][channel][row_block_samples]
  double* rows;
  double* screws;  // [joint][6][n_lanes]
};

// the columns that stand of most links: my, mx, xx, xy, xz, yz, zz
inline constexpr unsigned usual_columns = 0b11'0111'0110;

}  // namespace torquescope::kernels
#endif

HWY_BEFORE_NAMESPACE();
namespace torquescope::kernels::HWY_NAMESPACE {
namespace {

using D = hn::CappedTag<double, n_lanes>;
using V = hn::Vec<D>;
inline constexpr D d;
inline constexpr std::size_t vector_lanes = hn::MaxLanes(d);

struct Triple {
  V x, y, z;
};

HWY_INLINE V set(double value) { return hn::Set(d, value); }
HWY_INLINE V dot(Triple const& a, V x, V y, V z) {
  return fused_mul_add(a.z, z, fused_mul_add(a.y, y, hn::Mul(a.x, x)));
}

// from frame k - 1 to frame k: about x by alpha, along x by a, along z by d, about z by theta
struct Passage {
  V cos_alpha, sin_alpha, cos_theta, sin_theta, a, d;

  HWY_INLINE Triple twisted(Triple const& t) const {
    return {t.x, fused_mul_add(cos_alpha, t.y, hn::Mul(sin_alpha, t.z)),
            fused_neg_mul_add(sin_alpha, t.y, hn::Mul(cos_alpha, t.z))};
  }
  HWY_INLINE Triple turned(Triple const& t) const {
    return {fused_mul_add(cos_theta, t.x, hn::Mul(sin_theta, t.y)),
            fused_neg_mul_add(sin_theta, t.x, hn::Mul(cos_theta, t.y)), t.z};
  }
};

// velocities, accelerations and their products, in the link's own frame
struct LinkMotion {
  Triple omega, alpha, acceleration;
  V xy, xz, yz;             // products of omega
  V xx_yy, yy_zz, zz_xx;    // differences of its squares
  Triple to_x, to_y, to_z;  // columns of skew(alpha) + skew(omega)^2: acceleration of a point per metre along x, y, z

  HWY_INLINE void multiply() {
    auto const& [x, y, z] = omega;
    V const xx = hn::Mul(x, x), yy = hn::Mul(y, y), zz = hn::Mul(z, z);
    xy = hn::Mul(x, y), xz = hn::Mul(x, z), yz = hn::Mul(y, z);
    xx_yy = hn::Sub(xx, yy), yy_zz = hn::Sub(yy, zz), zz_xx = hn::Sub(zz, xx);
    to_x = {hn::Neg(hn::Add(yy, zz)), hn::Add(xy, alpha.z), hn::Sub(xz, alpha.y)};
    to_y = {hn::Sub(xy, alpha.z), hn::Neg(hn::Add(zz, xx)), hn::Add(yz, alpha.x)};
    to_z = {hn::Add(xz, alpha.y), hn::Sub(yz, alpha.x), hn::Neg(hn::Add(xx, yy))};
  }
};

// a joint's axis in the frame of a link behind it: moment.N + force.F is what passes the joint
struct Screw {
  Triple moment, force;

  HWY_INLINE static Screw load(double const* from) {
    auto const number = [from](std::size_t i) { return hn::LoadU(d, from + i * n_lanes); };
    return {{number(0), number(1), number(2)}, {number(3), number(4), number(5)}};
  }
  HWY_INLINE void store(double* to) const {
    V const numbers[] = {moment.x, moment.y, moment.z, force.x, force.y, force.z};
#pragma GCC unroll 6
    for (std::size_t i = 0; i < 6; ++i) hn::StoreU(numbers[i], d, to + i * n_lanes);
  }
  HWY_INLINE Screw carried(Passage const& over) const {
    Triple const m = over.twisted(moment);
    Triple f = over.twisted(force);
    f.x = fused_mul_add(m.y, over.d, f.x);
    f.y = fused_mul_add(m.z, over.a, fused_neg_mul_add(m.x, over.d, f.y));
    f.z = fused_neg_mul_add(m.y, over.a, f.z);
    return {over.turned(m), over.turned(f)};
  }
  HWY_INLINE V of_moment(V x, V y, V z) const { return dot(moment, x, y, z); }
  HWY_INLINE V of_force(Triple const& at) const { return dot(force, at.x, at.y, at.z); }
};

// of a joint in the frame of its own link: along z, so that one product of each dot product is left
struct TurningAxis {
  V weight;
  HWY_INLINE Screw screw() const {
    V const zero = hn::Zero(d);
    return {{zero, zero, weight}, {zero, zero, zero}};
  }
};
struct SlidingAxis {
  V weight;
  HWY_INLINE Screw screw() const {
    V const zero = hn::Zero(d);
    return {{zero, zero, zero}, {zero, zero, weight}};
  }
};

// column c of a link in the row of a screw
template <unsigned c>
HWY_INLINE V column(LinkMotion const& at, Screw const& s) {
  Triple const &a = at.acceleration, &u = s.moment;
  if constexpr (c == 0) return s.of_force(a);
  if constexpr (c == 1) return fused_neg_mul_add(u.y, a.z, fused_mul_add(u.z, a.y, s.of_force(at.to_x)));
  if constexpr (c == 2) return fused_neg_mul_add(u.z, a.x, fused_mul_add(u.x, a.z, s.of_force(at.to_y)));
  if constexpr (c == 3) return fused_neg_mul_add(u.x, a.y, fused_mul_add(u.y, a.x, s.of_force(at.to_z)));
  if constexpr (c == 4) return s.of_moment(at.alpha.x, at.xz, hn::Neg(at.xy));
  if constexpr (c == 5) return s.of_moment(hn::Neg(at.to_x.z), at.to_y.z, at.xx_yy);
  if constexpr (c == 6) return s.of_moment(at.to_x.y, at.zz_xx, hn::Neg(at.to_z.y));
  if constexpr (c == 7) return s.of_moment(hn::Neg(at.yz), at.alpha.y, at.xy);
  if constexpr (c == 8) return s.of_moment(at.yy_zz, hn::Neg(at.to_y.x), at.to_z.x);
  if constexpr (c == 9) return s.of_moment(at.yz, hn::Neg(at.xz), at.alpha.z);
}
template <unsigned c>
HWY_INLINE V column(LinkMotion const& at, TurningAxis const& s) {
  if constexpr (c == 1)
    return hn::Mul(s.weight, at.acceleration.y);
  else if constexpr (c == 2)
    return hn::Neg(hn::Mul(s.weight, at.acceleration.x));
  else if constexpr (c == 4)
    return hn::Neg(hn::Mul(s.weight, at.xy));
  else if constexpr (c == 5)
    return hn::Mul(s.weight, at.xx_yy);
  else if constexpr (c == 6)
    return hn::Neg(hn::Mul(s.weight, at.to_z.y));
  else if constexpr (c == 7)
    return hn::Mul(s.weight, at.xy);
  else if constexpr (c == 8)
    return hn::Mul(s.weight, at.to_z.x);
  else if constexpr (c == 9)
    return hn::Mul(s.weight, at.alpha.z);
  else
    return hn::Zero(d);
}
template <unsigned c>
HWY_INLINE V column(LinkMotion const& at, SlidingAxis const& s) {
  if constexpr (c == 0)
    return hn::Mul(s.weight, at.acceleration.z);
  else if constexpr (c == 1)
    return hn::Mul(s.weight, at.to_x.z);
  else if constexpr (c == 2)
    return hn::Mul(s.weight, at.to_y.z);
  else if constexpr (c == 3)
    return hn::Mul(s.weight, at.to_z.z);
  else
    return hn::Zero(d);
}

// columns c, c + 1, ... of those in `stand`
template <unsigned c, class Axis>
HWY_INLINE void write_columns(LinkMotion const& at, Axis const& axis, unsigned stand, double* HWY_RESTRICT out) {
  if constexpr (c < 10) {
    if ((stand >> c & 1) != 0) {
      hn::StoreU(column<c>(at, axis), d, out);
      out += n_lanes;
    }
    write_columns<c + 1>(at, axis, stand, out);
  }
}

template <class Axis>
HWY_INLINE void write_link(LinkMotion const& at, Axis const& axis, unsigned stand, double* HWY_RESTRICT out) {
  // a constant leaves no branch
  if (stand == usual_columns) return write_columns<0>(at, axis, usual_columns, out);
  write_columns<0>(at, axis, stand, out);
}

HWY_INLINE V direction_of(V speed) {
  return hn::IfThenZeroElse(hn::Eq(speed, hn::Zero(d)), hn::CopySign(set(1.0), speed));
}

// one vector of samples of one block, link after link
class VectorOfRows {
 public:
  HWY_INLINE VectorOfRows(RowBlock const& block, std::size_t sample)
      : block_(block), plan_(*block.plan), sample_(sample) {
    V const zero = hn::Zero(d);
    auto const& g = plan_.gravity();
    link_.omega = link_.alpha = {zero, zero, zero};
    link_.acceleration = {set(-g[0]), set(-g[1]), set(-g[2])};
    link_.multiply();
  }

  HWY_INLINE void pass_link(std::size_t k) {
    ArmJoint const& joint = plan_.joints()[k];
    Passage const over{set(joint.cos_alpha), set(joint.sin_alpha), channel(k, cosine),
                       channel(k, sine),     set(joint.a),         channel(k, distance)};
    move(over, joint.motion, channel(k, speed), channel(k, push));
    unsigned const stand = joint.link_columns;
    for (std::size_t j = 0; j < k; ++j) {
      double* const stored = block_.screws + j * 6 * n_lanes;
      Screw const screw = Screw::load(stored).carried(over);
      screw.store(stored);
      write_link(link_, screw, stand, place(j, plan_.columns_before(k) - plan_.columns_before(j)));
    }
    if (joint.motion == JointMotion::turns) return own_row(k, TurningAxis{channel(k, weight)});
    own_row(k, SlidingAxis{channel(k, weight)});
  }

 private:
  HWY_INLINE V channel(std::size_t joint, Channel which) const {
    return hn::LoadU(d, block_.channels + (joint * n_channels + which) * row_block_samples + sample_);
  }
  // where a column of a row goes
  HWY_INLINE double* place(std::size_t joint, std::size_t column) const {
    std::size_t const before = sample_ / n_lanes * plan_.row_width(joint);
    return block_.rows + plan_.rows_before(joint) + (before + column) * n_lanes + sample_ % n_lanes;
  }

  // outwards over one joint
  HWY_INLINE void move(Passage const& over, JointMotion motion, V rate, V change) {
    // the next origin, seen from the link before
    V const y = hn::Neg(hn::Mul(over.sin_alpha, over.d)), z = hn::Mul(over.cos_alpha, over.d);
    auto const origin = [&](V at, V to_x, V to_y, V to_z) {
      return fused_mul_add(to_z, z, fused_mul_add(to_y, y, fused_mul_add(to_x, over.a, at)));
    };
    Triple const before = link_.acceleration;
    link_.acceleration = {origin(before.x, link_.to_x.x, link_.to_y.x, link_.to_z.x),
                          origin(before.y, link_.to_x.y, link_.to_y.y, link_.to_z.y),
                          origin(before.z, link_.to_x.z, link_.to_y.z, link_.to_z.z)};
    for (Triple* const t : {&link_.omega, &link_.alpha, &link_.acceleration}) *t = over.turned(over.twisted(*t));

    Triple const& w = link_.omega;
    if (motion == JointMotion::turns) {
      link_.alpha.x = fused_mul_add(w.y, rate, link_.alpha.x);
      link_.alpha.y = fused_neg_mul_add(w.x, rate, link_.alpha.y);
      link_.alpha.z = hn::Add(link_.alpha.z, change);
      link_.omega.z = hn::Add(link_.omega.z, rate);
    } else {
      V const twice = hn::Add(rate, rate);
      link_.acceleration.x = fused_mul_add(w.y, twice, link_.acceleration.x);
      link_.acceleration.y = fused_neg_mul_add(w.x, twice, link_.acceleration.y);
      link_.acceleration.z = hn::Add(link_.acceleration.z, change);
    }
    link_.multiply();
  }

  template <class Axis>
  HWY_INLINE void own_row(std::size_t k, Axis const& axis) {
    ArmJoint const& joint = plan_.joints()[k];
    axis.screw().store(block_.screws + k * 6 * n_lanes);
    write_link(link_, axis, joint.link_columns, place(k, 0));
    double* out = place(k, plan_.columns_before(plan_.size()) - plan_.columns_before(k));
    V const w = channel(k, weight), rate = channel(k, speed);
    auto const append = [&out](V value) {
      hn::StoreU(value, d, out);
      out += n_lanes;
    };
    if ((joint.own_columns & own_acceleration) != 0) append(hn::Mul(w, channel(k, push)));
    if ((joint.own_columns & own_speed) != 0) append(hn::Mul(w, rate));
    if ((joint.own_columns & own_direction) != 0) append(hn::Mul(w, direction_of(rate)));
    if ((joint.own_columns & own_one) != 0) append(w);
    append(hn::Mul(w, channel(k, torque)));
  }

  RowBlock const& block_;
  ArmPlan const& plan_;
  std::size_t sample_;
  LinkMotion link_;
};

}  // namespace

void rows_of_block(RowBlock const& block) {
  std::size_t const n_joints = block.plan->size();
  for (std::size_t sample = 0; sample < block.n_groups * n_lanes; sample += vector_lanes) {
    VectorOfRows rows(block, sample);
    for (std::size_t k = 0; k < n_joints; ++k) rows.pass_link(k);
  }
}

}  // namespace torquescope::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace torquescope::kernels {
namespace {

TORQUESCOPE_EXPORT(rows_of_block);

std::size_t bits_of(unsigned mask) { return static_cast<std::size_t>(std::popcount(mask)); }

// copies samples to a channel and fills the last group up with `rest`
void copy_channel(double const* from, std::size_t count, double rest, double* channel) {
  std::copy_n(from, count, channel);
  std::fill(channel + count, channel + group_count(count) * n_lanes, rest);
}

void load_joint(ArmJoint const& joint, JointSignals const& signals, std::size_t first, std::size_t count,
                double* channels) {
  auto const channel = [channels](Channel which) { return channels + which * row_block_samples; };
  std::size_t const padded = group_count(count) * n_lanes;
  copy_channel(signals.dq + first, count, 0.0, channel(speed));
  copy_channel(signals.ddq + first, count, 0.0, channel(push));
  copy_channel(signals.tau + first, count, 0.0, channel(torque));
  if (signals.root_weight != nullptr) {
    copy_channel(signals.root_weight + first, count, 0.0, channel(weight));
  } else {
    std::fill_n(channel(weight), count, 1.0);
    std::fill(channel(weight) + count, channel(weight) + padded, 0.0);
  }

  bool const turns = joint.motion == JointMotion::turns;
  copy_channel(signals.q + first, count, 0.0, channel(turns ? cosine : distance));
  double* const angle = channel(cosine);
  for (std::size_t t = 0; t < padded; ++t) {
    angle[t] = joint.offset + (turns ? angle[t] : 0.0);
    channel(distance)[t] = joint.d + (turns ? 0.0 : channel(distance)[t]);
  }
  cosine_sine_of_multiple(1.0, angle, padded, angle, channel(sine));
}

}  // namespace

ArmPlan::ArmPlan(std::vector<ArmJoint> joints, std::array<double, 3> const& gravity)
    : joints_(std::move(joints)), gravity_(gravity), columns_before_{0}, rows_before_{0} {
  for (auto const& joint : joints_) columns_before_.push_back(columns_before_.back() + bits_of(joint.link_columns));
  for (std::size_t j = 0; j < size(); ++j)
    rows_before_.push_back(rows_before_.back() + row_width(j) * row_block_samples);
}

std::size_t ArmPlan::row_width(std::size_t joint) const {
  return columns_before_.back() - columns_before_[joint] + bits_of(joints_[joint].own_columns) + 1;
}

// channels and screws
std::size_t arm_rows_workspace_size(ArmPlan const& plan) {
  return plan.size() * (n_channels * row_block_samples + 6 * n_lanes);
}

void arm_rows(ArmPlan const& plan, JointSignals const* signals, std::size_t first, std::size_t count, double* rows,
              double* workspace) {
  std::size_t const of_joint = n_channels * row_block_samples;
  for (std::size_t j = 0; j < plan.size(); ++j)
    load_joint(plan.joints()[j], signals[j], first, count, workspace + j * of_joint);
  TORQUESCOPE_DISPATCH(rows_of_block)
  ({&plan, group_count(count), workspace, rows, workspace + plan.size() * of_joint});
}

}  // namespace torquescope::kernels
#endif  // HWY_ONCE
