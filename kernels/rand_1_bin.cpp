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

  HWY_INLINE TwoBlocks(PhiloxBlocks const& blocks, Keys const& keys, std::size_t i)
      : even(blocks.after_three_rounds(static_cast<std::uint32_t>(2 * i))),
        odd(blocks.after_three_rounds(static_cast<std::uint32_t>(2 * i + 1))) {
    for (int round = 3; round < 10; ++round) {
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

// what each lane picked, and a draw per parameter, in the memory of one member after the other
struct Rows {
  static constexpr std::size_t lanes = hn::MaxLanes(Reals()), draws_at_once = 4;
  std::int64_t target[lanes], base[lanes], plus[lanes], minus[lanes], j_rand[lanes];
  double draws[draws_at_once * lanes];

  explicit HWY_INLINE Rows(Picked const& picked) {
    constexpr Indices indices;
    hn::StoreU(picked.target, indices, target);
    hn::StoreU(picked.base, indices, base);
    hn::StoreU(picked.plus, indices, plus);
    hn::StoreU(picked.minus, indices, minus);
    hn::StoreU(picked.j_rand, indices, j_rand);
  }
};

// Writes parameters j .. j + count - 1 of a lane's trial; returns whether all are inside. A member's parameters lie
// side by side: gathering one of each member costs several times as much
HWY_INLINE bool make_parameters(Rand1Bin const& population, Rows const& rows, std::size_t lane, std::size_t j,
                                std::size_t count, double* trials) {
  using Few = hn::CappedTag<double, Rows::draws_at_once>;
  constexpr Few few;
  constexpr std::size_t at_once = hn::MaxLanes(few);
  double const* const base = population.members + rows.base[lane] + j;
  double const* const plus = population.members + rows.plus[lane] + j;
  double const* const minus = population.members + rows.minus[lane] + j;
  double const* const target = population.members + rows.target[lane] + j;
  double const* const draws = rows.draws + Rows::draws_at_once * lane;
  double* const trial = trials + rows.target[lane] + j;
  std::int64_t const j_rand = rows.j_rand[lane] - static_cast<std::int64_t>(j);
  // Highway 1.0.3 builds Iota through memory
  static constexpr double places[Rows::draws_at_once] = {0.0, 1.0, 2.0, 3.0};
  bool inside = true;
  std::size_t k = 0;
  for (; k + at_once <= count; k += at_once) {
    auto const difference = hn::Sub(hn::LoadU(few, plus + k), hn::LoadU(few, minus + k));
    auto const mutant = hn::Add(hn::LoadU(few, base + k), hn::Mul(hn::Set(few, population.F), difference));
    auto const from_mutant = hn::Or(hn::Lt(hn::LoadU(few, draws + k), hn::Set(few, population.CR)),
                                    hn::Eq(hn::LoadU(few, places + k), hn::Set(few, static_cast<double>(j_rand))));
    auto const made = hn::IfThenElse(from_mutant, mutant, hn::LoadU(few, target + k));
    hn::StoreU(made, few, trial + k);
    auto const between = hn::And(hn::Ge(made, hn::LoadU(few, population.lower + j + k)),
                                 hn::Le(made, hn::LoadU(few, population.upper + j + k)));
    inside = inside && hn::AllTrue(few, between);
  }
  for (; k < count; ++k) {
    bool const from_mutant = draws[k] < population.CR || j_rand == static_cast<std::int64_t>(k);
    trial[k] = from_mutant ? base[k] + population.F * (plus[k] - minus[k]) : target[k];
    inside = inside && trial[k] >= population.lower[j + k] && trial[k] <= population.upper[j + k];
  }
  return inside;
}

}  // namespace

void all_trials(Rand1Bin const& population, PhiloxStreams const& streams, Targets targets, double* trials,
                std::uint8_t* outside) {
  constexpr Reals reals;
  constexpr std::size_t lanes = Rows::lanes;
  Keys const keys(streams.key[0], streams.key[1]);
  // made once: Highway 1.0.3 builds it through memory
  Index const lane = hn::Iota(Indices(), 0);
  Index const last = hn::Set(Indices(), static_cast<std::int64_t>(targets.first + targets.count - 1));
  std::fill_n(outside, targets.count, std::uint8_t{0});
  for (std::size_t done = 0; done < targets.count; done += lanes) {
    // lanes without a member repeat the last one; nobody looks at them
    Index const begin = hn::Set(Indices(), static_cast<std::int64_t>(targets.first + done));
    Index const member = hn::Min(hn::Add(begin, lane), last);
    Words const stream = hn::Add(hn::Set(Wide(), streams.first_word_1), hn::BitCast(Wide(), member));
    PhiloxBlocks const blocks(streams, keys, stream);
    Rows rows(Picked(population, member, TwoBlocks(blocks, keys, 0)));
    std::size_t const members = std::min(lanes, targets.count - done);
    for (std::size_t j = 0; j < population.dimension; j += Rows::draws_at_once) {
      TwoBlocks const draws(blocks, keys, 1 + j / Rows::draws_at_once);
      hn::StoreInterleaved4(uniform(draws.even.word_0, draws.even.word_1),
                            uniform(draws.even.word_2, draws.even.word_3), uniform(draws.odd.word_0, draws.odd.word_1),
                            uniform(draws.odd.word_2, draws.odd.word_3), reals, rows.draws);
      std::size_t const count = std::min(Rows::draws_at_once, population.dimension - j);
      for (std::size_t i = 0; i < members; ++i)
        if (!make_parameters(population, rows, i, j, count, trials)) outside[done + i] = 1;
    }
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
