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
#include "kernels/link_columns-inl.hpp"

#ifndef TORQUESCOPE_KERNELS_ARM_ROWS_BLOCK
#define TORQUESCOPE_KERNELS_ARM_ROWS_BLOCK
namespace torquescope::kernels {

// of the angle or the distance of a joint, samples in sequence
enum Channel : std::size_t { cosine, sine, distance, n_channels };
// what a joint brings to its rows as it is recorded
enum Signal : std::size_t { speed, push, torque, weight, n_signals };

struct RowBlock {
  ArmPlan const* plan;
  JointSignals const* signals;
  std::size_t first, n_whole, n_groups;  // sample; groups of 8 samples, and with the last one
  double const* channels;                // [joint][Channel][row_block_samples]
  double const* last;                    // [joint][Signal][n_lanes]: the last group where it is not whole
  double* screws;                        // [joint][6][n_lanes]
  double* rows;
};

// the columns that stand of most links: my, mx, xx, xy, xz, yz, zz
inline constexpr unsigned usual_columns = 0b11'0111'0110;

}  // namespace torquescope::kernels
#endif

HWY_BEFORE_NAMESPACE();
namespace torquescope::kernels::HWY_NAMESPACE {
namespace {

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
    switch (twist_of(joint.cos_alpha, joint.sin_alpha)) {
      case Twist::none:
        return pass<Twist::none>(joint, k);
      case Twist::quarter:
        return pass<Twist::quarter>(joint, k);
      case Twist::quarter_back:
        return pass<Twist::quarter_back>(joint, k);
      case Twist::any:
        return pass<Twist::any>(joint, k);
    }
  }

 private:
  template <Twist twist>
  HWY_INLINE void pass(ArmJoint const& joint, std::size_t k) {
    Passage<twist> const over{set(joint.cos_alpha), set(joint.sin_alpha), channel(k, cosine),
                              channel(k, sine),     set(joint.a),         distance_of(k)};
    move(over, joint.motion, signal(k, speed), signal(k, push));
    unsigned const stand = joint.link_columns;
    for (std::size_t j = 0; j < k; ++j) {
      double* const stored = block_.screws + j * 6 * n_lanes;
      Screw const screw = Screw::load(stored).carried(over);
      screw.store(stored);
      write_link(link_, screw, stand, place(j, plan_.columns_before(k) - plan_.columns_before(j)));
    }
    if (joint.motion == JointMotion::turns) return own_row(k, TurningAxis{signal(k, weight)});
    own_row(k, SlidingAxis{signal(k, weight)});
  }

  HWY_INLINE V channel(std::size_t joint, Channel which) const {
    return hn::LoadU(d, block_.channels + (joint * n_channels + which) * row_block_samples + sample_);
  }
  HWY_INLINE V distance_of(std::size_t joint) const {
    return plan_.joints()[joint].motion == JointMotion::turns ? set(plan_.joints()[joint].d) : channel(joint, distance);
  }
  HWY_INLINE V signal(std::size_t joint, Signal which) const {
    if (sample_ / n_lanes == block_.n_whole)
      return hn::LoadU(d, block_.last + (joint * n_signals + which) * n_lanes + sample_ % n_lanes);
    JointSignals const& of = block_.signals[joint];
    double const* const from = which == speed    ? of.dq
                               : which == push   ? of.ddq
                               : which == torque ? of.tau
                                                 : of.root_weight;
    return from == nullptr ? set(1.0) : hn::LoadU(d, from + block_.first + sample_);
  }
  // where a column of a row goes
  HWY_INLINE double* place(std::size_t joint, std::size_t column) const {
    std::size_t const before = sample_ / n_lanes * plan_.row_width(joint);
    return block_.rows + plan_.rows_before(joint) + (before + column) * n_lanes + sample_ % n_lanes;
  }

  // outwards over one joint
  template <Twist twist>
  HWY_INLINE void move(Passage<twist> const& over, JointMotion motion, V rate, V change) {
    // the next origin, seen from the link before
    V const y = hn::Neg(hn::Mul(over.sin_alpha, over.d)), z = hn::Mul(over.cos_alpha, over.d);
    auto const origin = [&](V at, V to_x, V to_y, V to_z) {
      return plus(to_z, z, plus(to_y, y, plus(to_x, over.a, at)));
    };
    Triple const before = link_.acceleration;
    link_.acceleration = {origin(before.x, link_.to_x.x, link_.to_y.x, link_.to_z.x),
                          origin(before.y, link_.to_x.y, link_.to_y.y, link_.to_z.y),
                          origin(before.z, link_.to_x.z, link_.to_y.z, link_.to_z.z)};
    for (Triple* const t : {&link_.omega, &link_.alpha, &link_.acceleration}) *t = over.turned(over.twisted(*t));

    Triple const& w = link_.omega;
    if (motion == JointMotion::turns) {
      link_.alpha.x = plus(w.y, rate, link_.alpha.x);
      link_.alpha.y = minus(w.x, rate, link_.alpha.y);
      link_.alpha.z = hn::Add(link_.alpha.z, change);
      link_.omega.z = hn::Add(link_.omega.z, rate);
    } else {
      V const twice = hn::Add(rate, rate);
      link_.acceleration.x = plus(w.y, twice, link_.acceleration.x);
      link_.acceleration.y = minus(w.x, twice, link_.acceleration.y);
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
    V const w = signal(k, weight), rate = signal(k, speed);
    auto const append = [&out](V value) {
      hn::StoreU(value, d, out);
      out += n_lanes;
    };
    if ((joint.own_columns & own_acceleration) != 0) append(hn::Mul(w, signal(k, push)));
    if ((joint.own_columns & own_speed) != 0) append(hn::Mul(w, rate));
    if ((joint.own_columns & own_direction) != 0) append(hn::Mul(w, direction_of(rate)));
    if ((joint.own_columns & own_one) != 0) append(w);
    append(hn::Mul(w, signal(k, torque)));
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

// cosine and sine, or the distance of a joint that slides; behind the last sample those of q = 0
void load_channels(ArmJoint const& joint, double const* q, std::size_t count, double* channels) {
  bool const turns = joint.motion == JointMotion::turns;
  std::size_t const padded = group_count(count) * n_lanes;
  double* const angle = channels + cosine * row_block_samples;
  double* const place = turns ? angle : channels + distance * row_block_samples;
  double const rest = turns ? joint.offset : joint.d;
  std::fill_n(angle, padded, joint.offset);
  for (std::size_t t = 0; t < count; ++t) place[t] = rest + q[t];
  std::fill(place + count, place + padded, rest);
  cosine_sine_of_multiple(1.0, angle, padded, angle, channels + sine * row_block_samples);
}

// fewer than n_lanes samples and zeros, of which the weight takes a row's numbers away
void load_last_group(JointSignals const& signals, std::size_t first, std::size_t count, double* last) {
  std::fill_n(last, n_signals * n_lanes, 0.0);
  std::copy_n(signals.dq + first, count, last + speed * n_lanes);
  std::copy_n(signals.ddq + first, count, last + push * n_lanes);
  std::copy_n(signals.tau + first, count, last + torque * n_lanes);
  double* const to = last + weight * n_lanes;
  if (signals.root_weight == nullptr)
    std::fill_n(to, count, 1.0);
  else
    std::copy_n(signals.root_weight + first, count, to);
}

}  // namespace

ArmPlan::ArmPlan(std::vector<ArmJoint> joints, std::array<double, 3> const& gravity)
    : joints_(std::move(joints)), gravity_(gravity), columns_before_{0}, rows_before_{0} {
  for (auto const& joint : joints_) columns_before_.push_back(columns_before_.back() + bits_of(joint.link_columns));
  for (std::size_t j = 0; j < size(); ++j) {
    row_width_.push_back(columns_before_.back() - columns_before_[j] + bits_of(joints_[j].own_columns) + 1);
    rows_before_.push_back(rows_before_.back() + row_width_.back() * row_block_samples);
  }
}

// channels, last groups, screws
std::size_t arm_rows_workspace_size(ArmPlan const& plan) {
  return plan.size() * (n_channels * row_block_samples + n_signals * n_lanes + 6 * n_lanes);
}

void arm_rows(ArmPlan const& plan, JointSignals const* signals, std::size_t first, std::size_t count, double* rows,
              double* workspace) {
  double* const channels = workspace;
  double* const last = channels + plan.size() * n_channels * row_block_samples;
  double* const screws = last + plan.size() * n_signals * n_lanes;
  std::size_t const n_whole = count / n_lanes, whole = n_whole * n_lanes;
  for (std::size_t j = 0; j < plan.size(); ++j) {
    load_channels(plan.joints()[j], signals[j].q + first, count, channels + j * n_channels * row_block_samples);
    if (whole < count) load_last_group(signals[j], first + whole, count - whole, last + j * n_signals * n_lanes);
  }
  TORQUESCOPE_DISPATCH(rows_of_block)
  ({&plan, signals, first, n_whole, group_count(count), channels, last, screws, rows});
}

void prefetch_samples(JointSignals const& signals, std::size_t first, std::size_t count) {
  for (double const* const signal : {signals.q, signals.dq, signals.ddq, signals.tau, signals.root_weight})
    for (std::size_t t = 0; signal != nullptr && t < count; t += n_lanes) __builtin_prefetch(signal + first + t);
}

}  // namespace torquescope::kernels
#endif  // HWY_ONCE
