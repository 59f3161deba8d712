// Motion of a link and the columns of its parameters in the row of a joint, for one vector of samples; compiled once
// per instruction set, so no #pragma once.
//
// Equation   column c: u.N_c + v.F_c (arm_rows.hpp); one fixed order of fused multiply-adds each
// Source     Khalil and Dombre 2002, Modeling, Identification and Control of Robots, sections 9.5 and 12.3

#include <cstddef>

#include "hwy/highway.h"
#include "kernels/double_lanes-inl.hpp"

#if defined(TORQUESCOPE_KERNELS_LINK_COLUMNS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef TORQUESCOPE_KERNELS_LINK_COLUMNS_INL
#undef TORQUESCOPE_KERNELS_LINK_COLUMNS_INL
#else
#define TORQUESCOPE_KERNELS_LINK_COLUMNS_INL
#endif

HWY_BEFORE_NAMESPACE();
namespace torquescope::kernels::HWY_NAMESPACE {
namespace {

struct Triple {
  V x, y, z;
};

// c + a b, c - a b
HWY_INLINE V plus(V a, V b, V c) { return fused_mul_add(a, b, c); }
HWY_INLINE V minus(V a, V b, V c) { return fused_neg_mul_add(a, b, c); }
HWY_INLINE V dot(Triple const& a, V x, V y, V z) { return plus(a.z, z, plus(a.y, y, hn::Mul(a.x, x))); }

// twist of a joint's axis against the one before: most arms have right angles, which cost no multiplication
enum class Twist { none, quarter, quarter_back, any };

HWY_INLINE Twist twist_of(double cos_alpha, double sin_alpha) {
  if (cos_alpha == 1.0 && sin_alpha == 0.0) return Twist::none;
  if (cos_alpha != 0.0) return Twist::any;
  return sin_alpha == 1.0 ? Twist::quarter : sin_alpha == -1.0 ? Twist::quarter_back : Twist::any;
}

// from frame k - 1 to frame k: about x by alpha, along x by a, along z by d, about z by theta
template <Twist twist>
struct Passage {
  V cos_alpha, sin_alpha, cos_theta, sin_theta, a, d;

  HWY_INLINE Triple twisted(Triple const& t) const {
    if constexpr (twist == Twist::none) return t;
    if constexpr (twist == Twist::quarter) return {t.x, t.z, hn::Neg(t.y)};
    if constexpr (twist == Twist::quarter_back) return {t.x, hn::Neg(t.z), t.y};
    return {t.x, plus(cos_alpha, t.y, hn::Mul(sin_alpha, t.z)), minus(sin_alpha, t.y, hn::Mul(cos_alpha, t.z))};
  }
  HWY_INLINE Triple turned(Triple const& t) const {
    return {plus(cos_theta, t.x, hn::Mul(sin_theta, t.y)), minus(sin_theta, t.x, hn::Mul(cos_theta, t.y)), t.z};
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
  template <Twist twist>
  HWY_INLINE Screw carried(Passage<twist> const& over) const {
    Triple const m = over.twisted(moment);
    Triple f = over.twisted(force);
    f.x = plus(m.y, over.d, f.x);
    f.y = plus(m.z, over.a, minus(m.x, over.d, f.y));
    f.z = minus(m.y, over.a, f.z);
    return {over.turned(m), over.turned(f)};
  }
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
  if constexpr (c == 1) return minus(u.y, a.z, plus(u.z, a.y, s.of_force(at.to_x)));
  if constexpr (c == 2) return minus(u.z, a.x, plus(u.x, a.z, s.of_force(at.to_y)));
  if constexpr (c == 3) return minus(u.x, a.y, plus(u.y, a.x, s.of_force(at.to_z)));
  // each has a minus: a fused one costs nothing
  if constexpr (c == 4) return minus(u.z, at.xy, plus(u.y, at.xz, hn::Mul(u.x, at.alpha.x)));
  if constexpr (c == 5) return plus(u.z, at.xx_yy, minus(u.x, at.to_x.z, hn::Mul(u.y, at.to_y.z)));
  if constexpr (c == 6) return minus(u.z, at.to_z.y, plus(u.y, at.zz_xx, hn::Mul(u.x, at.to_x.y)));
  if constexpr (c == 7) return plus(u.z, at.xy, minus(u.x, at.yz, hn::Mul(u.y, at.alpha.y)));
  if constexpr (c == 8) return plus(u.z, at.to_z.x, minus(u.y, at.to_y.x, hn::Mul(u.x, at.yy_zz)));
  if constexpr (c == 9) return plus(u.z, at.alpha.z, minus(u.y, at.xz, hn::Mul(u.x, at.yz)));
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

}  // namespace
}  // namespace torquescope::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
