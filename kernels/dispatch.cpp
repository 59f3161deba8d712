#include "kernels/dispatch.hpp"

#include <cstdint>

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

HWY_EXPORT(target);
HWY_EXPORT(has_fma);

// one bit per instruction set, lower bits are better; asked once, before anything is forced
std::int64_t machine_targets() {
  static std::int64_t const targets = hwy::SupportedTargets() & HWY_TARGETS;
  return targets;
}

}  // namespace

std::string_view instruction_set() { return hwy::TargetName(HWY_DYNAMIC_DISPATCH(target)()); }

bool instruction_set_has_fma() { return HWY_DYNAMIC_DISPATCH(has_fma)(); }

std::vector<std::string_view> supported_instruction_sets() {
  std::vector<std::string_view> names;
  for (std::int64_t rest = machine_targets(); rest != 0; rest &= rest - 1)
    names.push_back(hwy::TargetName(rest & -rest));
  return names;
}

bool force_instruction_set(std::string_view name) {
  for (std::int64_t rest = machine_targets(); rest != 0; rest &= rest - 1) {
    std::int64_t const candidate = rest & -rest;
    if (name != hwy::TargetName(candidate)) continue;
    hwy::SetSupportedTargetsForTest(candidate);
    return true;
  }
  return false;
}

void release_instruction_set() {
  machine_targets();
  hwy::SetSupportedTargetsForTest(0);
}

}  // namespace torquescope::kernels
#endif  // HWY_ONCE
