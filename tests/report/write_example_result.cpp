// write_example_result OUT.h5 [example | large | "large gzip"]: the results that test_read_result.py reads.

#include <cstdio>
#include <string>

#include "engine/base/error.hpp"
#include "unit/store/example_result.hpp"

int main(int n_arguments, char** arguments) {
  if (n_arguments < 2 || n_arguments > 3) {
    std::fputs("usage: write_example_result OUT.h5 [example | large | \"large gzip\"]\n", stderr);
    return 64;
  }
  try {
    using namespace torquescope::example;
    std::string const which = n_arguments == 3 ? arguments[2] : "example";
    std::puts((which == "example" ? write_result(arguments[1])
                                  : write_large_result(arguments[1], {.gzip = which == "large gzip"}))
                  .c_str());
  } catch (torquescope::Error const& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return static_cast<int>(error.code());
  }
}
