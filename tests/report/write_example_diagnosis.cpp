// write_example_diagnosis OUT.h5 [named|class|partly|none|unexplained|insufficient|data_fault]: a result with an
// invented diagnosis.

#include <cstdio>
#include <functional>
#include <map>
#include <string>

#include "engine/base/error.hpp"
#include "support/example_diagnosis.hpp"
#include "support/example_diagnosis_file.hpp"

int main(int n_arguments, char** arguments) {
  namespace example = torquescope::example;
  std::map<std::string, std::function<torquescope::Diagnosis()>> const kinds{
      {"named", example::invented_diagnosis},         {"class", example::invented_class},
      {"partly", example::invented_partly},           {"none", example::invented_none},
      {"unexplained", example::invented_unexplained}, {"insufficient", example::invented_insufficient},
      {"data_fault", example::invented_data_fault}};
  std::string const kind = n_arguments > 2 ? arguments[2] : "named";
  if (n_arguments < 2 || !kinds.contains(kind)) {
    std::fputs("usage: write_example_diagnosis OUT.h5 [named|class|partly|none|unexplained|insufficient|data_fault]\n",
               stderr);
    return 64;
  }
  try {
    std::puts(example::write_diagnosis_file(arguments[1], kinds.at(kind)()).c_str());
  } catch (torquescope::Error const& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return static_cast<int>(error.code());
  }
}
