#pragma once
// Promises between parts of the program: TORQUESCOPE_EXPECT is the caller's, TORQUESCOPE_ENSURE our own.
//
// Checked in builds with TORQUESCOPE_CONTRACTS (presets dev, audit, asan, tsan, tidy); elsewhere they cost nothing and
// their condition is not evaluated. What a user can get wrong is never a contract: see error.hpp.
//
// Errors     BrokenPromise, with file and line; the program maps it to exit code 70

#include <stdexcept>
#include <string>

namespace torquescope {

class BrokenPromise : public std::logic_error {
 public:
  BrokenPromise(char const* condition, char const* file, int line)
      : std::logic_error(std::string("broken promise in ") + file + ":" + std::to_string(line) + ": " + condition) {}
};

}  // namespace torquescope

#if defined(TORQUESCOPE_CONTRACTS)
#define TORQUESCOPE_PROMISE(condition) \
  ((condition) ? void(0) : throw ::torquescope::BrokenPromise(#condition, __FILE__, __LINE__))
#else
#define TORQUESCOPE_PROMISE(condition) void(sizeof(!(condition)))
#endif

// macros, because only a macro knows the line it stands on; prefixed, because Eigen and fmt have names of their own
#define TORQUESCOPE_EXPECT(condition) TORQUESCOPE_PROMISE(condition)
#define TORQUESCOPE_ENSURE(condition) TORQUESCOPE_PROMISE(condition)
