#pragma once
// The ceiling of this machine at this moment: fused multiply-adds of doubles per second of one thread.
//
// Runs on    the instruction set the kernels run on (kernels/dispatch.hpp); meaningless where it has no FMA
// Method     as many independent accumulators as registers hold, nothing but FMA in the loop; thread CPU time

namespace torquescope::bench {

// seconds of CPU time this thread has used
double thread_cpu_seconds();
// best of several short bursts, about 2 ms in all
double fma_per_second();

}  // namespace torquescope::bench
