#include "kernels/rand_1_bin.hpp"

#include <algorithm>
#include <cassert>

#include "kernels/dispatch-inl.hpp"

// the part up to HWY_ONCE is compiled once per instruction set
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/rand_1_bin.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"
#include "kernels/philox-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace torquescope::kernels::HWY_NAMESPACE {
namespace {

using Reals = hn::CappedTag<double, 8>;
using Indices = hn::CappedTag<std::int64_t, 8>;
using Real = hn::Vec<Reals>;
using Index = hn::Vec<Indices>;

// 0 .. n-1 from the second word of a draw, by multiply-shift as RandomStream::below
HWY_INLINE Index below(Words second_words, std::size_t n) {
  return hn::BitCast(Indices(), hn::ShiftRight<32>(product(second_words, hn::Set(Wide(), n))));
}

// [0, 1), 53 bits, as RandomStream::uniform
HWY_INLINE Real uniform(Words first, Words second) {
  auto const bits = hn::ShiftRight<11>(joined(first, second));
  return hn::Mul(hn::ConvertTo(Reals(), hn::BitCast(Indices(), bits)), hn::Set(Reals(), 0x1.0p-53));
}

// one further where a taken member is at or before it
HWY_INLINE Index moved_past(Index index, Index taken) {
  return hn::IfThenElse(hn::Lt(index, taken), index, hn::Add(index, hn::Set(Indices(), 1)));
}

// blocks 2 i and 2 i + 1 of each lane's stream: a block alone waits for its products
struct TwoBlocks {
  PhiloxLanes even, odd;

  HWY_INLINE TwoBlocks(PhiloxStreams const& streams, Keys const& keys, Words stream, std::size_t i)
      : even{hn::Set(Wide(), 2 * i), stream, hn::Set(Wide(), streams.word_2), hn::Set(Wide(), streams.word_3)},
        odd(even) {
    odd.word_0 = hn::Set(Wide(), 2 * i + 1);
    for (int round = 0; round < 10; ++round) {
      Words const key_0 = hn::Set(Wide(), keys.word_0[round]), key_1 = hn::Set(Wide(), keys.word_1[round]);
      even.round(key_0, key_1);
      odd.round(key_0, key_1);
    }
  }
};

// of one member in each lane
struct Picked {
  Index target, base, plus, minus, j_rand;  // members as the place of their first parameter

  HWY_INLINE Picked(Rand1Bin const& population, Index member, TwoBlocks const& draws) : target(member) {
    std::size_t const n = population.n_members;
    Index const r1 = moved_past(below(draws.even.word_1, n - 1), target);
    Index const low = hn::Min(target, r1), high = hn::Max(target, r1);
    Index const r2 = moved_past(moved_past(below(draws.even.word_3, n - 2), low), high);
    Index const middle = hn::Max(low, hn::Min(high, r2));
    Index r3 = moved_past(below(draws.odd.word_1, n - 3), hn::Min(low, r2));
    r3 = moved_past(moved_past(r3, middle), hn::Max(high, r2));
    j_rand = below(draws.odd.word_3, population.dimension);
    target = place_of(target, population.dimension);
    base = place_of(r1, population.dimension);
    plus = place_of(r2, population.dimension);
    minus = place_of(r3, population.dimension);
  }

  static HWY_INLINE Index place_of(Index member, std::size_t dimension) {
    return hn::BitCast(Indices(), product(hn::BitCast(Wide(), member), hn::Set(Wide(), dimension)));
  }
};

// writes parameter j of each lane's trial; returns where it is inside
HWY_INLINE hn::Mask<Reals> make_parameter(Rand1Bin const& population, Picked const& picked, std::size_t j, Real b,
                                          double* trials) {
  constexpr Reals reals;
  double const* const column = population.members + j;
  Real const difference =
      hn::Sub(hn::GatherIndex(reals, column, picked.plus), hn::GatherIndex(reals, column, picked.minus));
  Real const mutant =
      hn::Add(hn::GatherIndex(reals, column, picked.base), hn::Mul(hn::Set(reals, population.F), difference));
  auto const is_j_rand = hn::RebindMask(reals, hn::Eq(picked.j_rand, hn::Set(Indices(), static_cast<std::int64_t>(j))));
  auto const from_mutant = hn::Or(hn::Lt(b, hn::Set(reals, population.CR)), is_j_rand);
  Real const trial = hn::IfThenElse(from_mutant, mutant, hn::GatherIndex(reals, column, picked.target));
  hn::ScatterIndex(trial, reals, trials + j, picked.target);
  return hn::And(hn::Ge(trial, hn::Set(reals, population.lower[j])),
                 hn::Le(trial, hn::Set(reals, population.upper[j])));
}

}  // namespace

void all_trials(Rand1Bin const& population, PhiloxStreams const& streams, Targets targets, double* trials,
                std::uint8_t* outside) {
  constexpr Reals reals;
  constexpr std::size_t lanes = hn::MaxLanes(reals);
  Keys const keys(streams.key[0], streams.key[1]);
  // made once: Highway 1.0.3 builds it through memory
  Index const lane = hn::Iota(Indices(), 0);
  Index const last = hn::Set(Indices(), static_cast<std::int64_t>(targets.first + targets.count - 1));
  for (std::size_t done = 0; done < targets.count; done += lanes) {
    // lanes without a member repeat the last one, and write the same numbers to the same place
    Index const begin = hn::Set(Indices(), static_cast<std::int64_t>(targets.first + done));
    Index const member = hn::Min(hn::Add(begin, lane), last);
    Words const stream = hn::Add(hn::Set(Wide(), streams.first_word_1), hn::BitCast(Wide(), member));
    Picked const picked(population, member, TwoBlocks(streams, keys, stream, 0));
    auto inside = hn::FirstN(reals, lanes);
    for (std::size_t j = 0; j < population.dimension; j += 4) {
      TwoBlocks const draws(streams, keys, stream, 1 + j / 4);
      Real const b[4] = {uniform(draws.even.word_0, draws.even.word_1), uniform(draws.even.word_2, draws.even.word_3),
                         uniform(draws.odd.word_0, draws.odd.word_1), uniform(draws.odd.word_2, draws.odd.word_3)};
      std::size_t const count = std::min(std::size_t{4}, population.dimension - j);
      for (std::size_t k = 0; k < count; ++k)
        inside = hn::And(inside, make_parameter(population, picked, j + k, b[k], trials));
    }
    std::size_t const count = std::min(lanes, targets.count - done);
    std::fill_n(outside + done, count, std::uint8_t{0});
    if (hn::AllTrue(reals, inside)) continue;
    double is_inside[lanes];
    hn::StoreU(hn::IfThenElseZero(inside, hn::Set(reals, 1.0)), reals, is_inside);
    for (std::size_t i = 0; i < count; ++i) outside[done + i] = is_inside[i] == 0.0 ? 1 : 0;
  }
}

}  // namespace torquescope::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace torquescope::kernels {
namespace {

TORQUESCOPE_EXPORT(all_trials);

}  // namespace

void rand_1_bin_trials(Rand1Bin const& population, PhiloxStreams const& streams, Targets targets, double* trials,
                       std::uint8_t* outside) {
  assert(population.n_members >= 4 && population.dimension >= 1);
  assert(targets.count >= 1 && targets.first + targets.count <= population.n_members);
  TORQUESCOPE_DISPATCH(all_trials)(population, streams, targets, trials, outside);
}

}  // namespace torquescope::kernels
#endif  // HWY_ONCE
