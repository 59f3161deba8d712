#pragma once
// A system call that a signal interrupted has done nothing: it is made again.
//
// Use        int descriptor = unless_interrupted([&] { return ::open(name, O_RDONLY); });
// Not for    close(): Linux has closed the descriptor whatever it says

#include <cerrno>

namespace torquescope {

template <class Call>
auto unless_interrupted(Call&& call) {
  auto result = call();
  while (result < 0 && errno == EINTR) result = call();
  return result;
}

}  // namespace torquescope
