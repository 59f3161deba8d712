#pragma once
// A table with one function per instruction set, and the entry that this machine runs: what HWY_EXPORT and
// HWY_DYNAMIC_DISPATCH of Highway do, without its library.
//
// Use        TORQUESCOPE_EXPORT(sum_block);                           within #if HWY_ONCE, once per function
//            auto const kernel = TORQUESCOPE_DISPATCH(sum_block);     a reference to the function; calling it costs one
//            jump
// Why        libhwy measures its clock as it is loaded: 2 ms of every process. And a pointer that was taken with
//            HWY_DYNAMIC_DISPATCH before anything was called is a function that asks the processor for its abilities on
//            every call, each time four instructions that a virtual machine answers in 7 to 30 us
// Threads    any
// Source     Highway 1.0.3, hwy/highway.h and hwy/targets.h: the same order of tables and bits

#include <bit>
#include <cstddef>
#include <cstdint>

namespace torquescope::kernels {

// one bit per instruction set as in HWY_TARGETS, lower ones are better: all this machine has, or the one that was
// forced
std::int64_t chosen_targets();

}  // namespace torquescope::kernels

// the first entry would choose on the first call: chosen_targets() is complete from the start
#define TORQUESCOPE_EXPORT(function)                                                                          \
  static decltype(&HWY_STATIC_DISPATCH(function)) const function##_by_target[HWY_MAX_DYNAMIC_TARGETS + 2] = { \
      nullptr, HWY_CHOOSE_TARGET_LIST(function), HWY_CHOOSE_FALLBACK(function)}

#define TORQUESCOPE_DISPATCH(function)                                                                           \
  (*function##_by_target[std::countr_zero(                                                                       \
      static_cast<std::uint64_t>(HWY_CHOSEN_TARGET_SHIFT(torquescope::kernels::chosen_targets() & HWY_TARGETS) | \
                                 HWY_CHOSEN_TARGET_MASK_SCALAR))])
