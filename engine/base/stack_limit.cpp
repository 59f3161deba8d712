#include "engine/base/stack_limit.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include "engine/base/error.hpp"

namespace torquescope {

void refuse_small_stack() {
  // Eigen puts temporaries of up to 128 KiB there, several at a time
  constexpr rlim_t least = rlim_t{1} << 20;
  rlimit limit{};
  if (::getrlimit(RLIMIT_STACK, &limit) != 0 || limit.rlim_cur >= least) return;
  throw Error(Problem{
      .code = ExitCode::internal,
      .what = fmt::format("the stack is limited to {} KiB here; {} are needed", limit.rlim_cur >> 10, least >> 10),
      .help = "ulimit -s 8192"});
}

}  // namespace torquescope
