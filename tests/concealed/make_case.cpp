// make_case NAME OUT_DIR          writes a sealed case to OUT_DIR/NAME
// make_case --clean SEED OUT_DIR  writes a clean record to OUT_DIR/clean_SEED
// make_case --list                names of the sealed cases, one per line
// make_case --words               effects, families, parameters, units and axes the truths are written with, as JSON
// Prints one line: seal, folder, realised effect size. Exit code 0; 64 usage; 1 with a message when it fails.
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <vector>

#include "concealed/case_writer.hpp"

namespace {

int usage() {
  std::fputs("usage: make_case NAME OUT_DIR | make_case --clean SEED OUT_DIR | make_case --list | make_case --words\n",
             stderr);
  return 64;
}

void make(concealed::Case const& one_case, std::filesystem::path const& out) {
  auto const report = concealed::report_case(one_case);
  auto const folder = out / one_case.name;
  std::string const seal = concealed::write_case(one_case, report, folder);
  std::printf("%s  %s  snr_eff %.3f  torque share %.3f %%  step error %.2g of torque noise, %.2g of encoder rounding\n",
              seal.c_str(), (folder / "truth.json").string().c_str(), report.together.snr(),
              100.0 * report.together.torque_share(), report.step_error.torque, report.step_error.position);
}

int run(std::vector<std::string> const& words) {
  if (words.size() == 1 && words[0] == "--list") {
    for (auto const& one_case : concealed::sealed_cases()) std::printf("%s\n", one_case.name.c_str());
    return 0;
  }
  if (words.size() == 1 && words[0] == "--words") {
    std::fputs(concealed::words_text().c_str(), stdout);
    return 0;
  }
  if (words.size() == 3 && words[0] == "--clean") {
    if (words[1].empty() || words[1].find_first_not_of("0123456789") != std::string::npos) return usage();
    make(concealed::clean_case(std::strtoull(words[1].c_str(), nullptr, 10)), words[2]);
    return 0;
  }
  if (words.size() != 2 || words[0].starts_with('-')) return usage();
  make(concealed::sealed_case(words[0]), words[1]);
  return 0;
}

}  // namespace

int main(int argc, char** argv) try { return run({argv + 1, argv + argc}); } catch (std::exception const& problem) {
  std::fprintf(stderr, "make_case: %s\n", problem.what());
  return 1;
}
