#include "kernels/dispatch.hpp"

#include <atomic>
#include <cstdint>

#include "kernels/dispatch-inl.hpp"

// this file is compiled once per instruction set
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/dispatch.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace torquescope::kernels::HWY_NAMESPACE {

std::int64_t target() { return HWY_TARGET; }
bool has_fma() { return HWY_NATIVE_FMA != 0; }

}  // namespace torquescope::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace torquescope::kernels {
namespace {

TORQUESCOPE_EXPORT(target);
TORQUESCOPE_EXPORT(has_fma);

// one bit per instruction set, lower bits are better
std::int64_t machine_targets() {
#if HWY_ARCH_X86 && (defined(__GNUC__) || defined(__clang__))
  // Highway also asks for LZCNT and F16C, which every processor with AVX2, BMI2 and FMA has; clang 14 cannot ask for
  // them
  __builtin_cpu_init();
  std::int64_t targets = HWY_STATIC_TARGET;
  if (!__builtin_cpu_supports("ssse3")) return targets;
  targets |= HWY_SSSE3;
  if (!__builtin_cpu_supports("sse4.2") || !__builtin_cpu_supports("pclmul") || !__builtin_cpu_supports("aes"))
    return targets & HWY_TARGETS;
  targets |= HWY_SSE4;
  if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("bmi") || !__builtin_cpu_supports("bmi2") ||
      !__builtin_cpu_supports("fma"))
    return targets & HWY_TARGETS;
  targets |= HWY_AVX2;
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512bw"))
    targets |= HWY_AVX3;
  return targets & HWY_TARGETS;
#else
  return hwy::SupportedTargets() & HWY_TARGETS;
#endif
}

// asked once
std::int64_t supported_targets() {
  static std::int64_t const targets = machine_targets();
  return targets;
}

// 0: none is forced
std::atomic<std::int64_t> forced_target{0};

}  // namespace

std::int64_t chosen_targets() {
  std::int64_t const forced = forced_target.load(std::memory_order_relaxed);
  return forced != 0 ? forced : supported_targets();
}

std::string_view instruction_set() { return hwy::TargetName(TORQUESCOPE_DISPATCH(target)()); }

bool instruction_set_has_fma() { return TORQUESCOPE_DISPATCH(has_fma)(); }

std::vector<std::string_view> supported_instruction_sets() {
  std::vector<std::string_view> names;
  for (std::int64_t rest = supported_targets(); rest != 0; rest &= rest - 1)
    names.push_back(hwy::TargetName(rest & -rest));
  return names;
}

bool force_instruction_set(std::string_view name) {
  for (std::int64_t rest = supported_targets(); rest != 0; rest &= rest - 1) {
    std::int64_t const candidate = rest & -rest;
    if (name != hwy::TargetName(candidate)) continue;
    forced_target = candidate;
    return true;
  }
  return false;
}

void release_instruction_set() { forced_target = 0; }

}  // namespace torquescope::kernels
#endif  // HWY_ONCE
