// write_example_result OUT.h5: the result that test_read_result.py reads.

#include <cstdio>

#include "engine/base/error.hpp"
#include "unit/store/example_result.hpp"

int main(int n_arguments, char** arguments) {
  if (n_arguments != 2) {
    std::fputs("usage: write_example_result OUT.h5\n", stderr);
    return 64;
  }
  try {
    std::puts(torquescope::example::write_result(arguments[1]).c_str());
  } catch (torquescope::Error const& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return static_cast<int>(error.code());
  }
}
