// make_arm_case NAME OUT_DIR                    writes a case (arm_case.hpp) to OUT_DIR/FOLDER
// make_arm_case --list TIER FROM..TO [SUITE]    names of drawn cases, for example A1 1..80, one per line
// make_arm_case --folders NAME...               folder of each case, one per line
// Prints one line: folder, SNR after absorption. Exit code 0; 64 usage; 1 with a message when it fails.
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "concealed_arms/case_files.hpp"

namespace {

int usage() {
  std::fputs(
      "usage: make_arm_case NAME OUT_DIR | make_arm_case --list TIER FROM..TO [SUITE] | make_arm_case --folders "
      "NAME...\n",
      stderr);
  return 64;
}

int list(std::string const& tier, std::string const& stretch, std::string const& suite) {
  auto const dots = stretch.find("..");
  if (dots == std::string::npos) return usage();
  int const from = std::stoi(stretch.substr(0, dots)), to = std::stoi(stretch.substr(dots + 2));
  for (int number = from; number <= to; ++number) {
    std::string const name = tier + ":" + std::to_string(number) + (suite.empty() ? "" : ":" + suite);
    concealed_arms::spelled_out(name);  // refuses what is no name
    std::printf("%s\n", name.c_str());
  }
  return 0;
}

int run(std::vector<std::string> const& words) {
  if ((words.size() == 3 || words.size() == 4) && words[0] == "--list")
    return list(words[1], words[2], words.size() == 4 ? words[3] : "");
  if (words.size() > 1 && words[0] == "--folders") {
    for (std::size_t i = 1; i < words.size(); ++i) std::printf("%s\n", concealed_arms::folder_of(words[i]).c_str());
    return 0;
  }
  if (words.size() != 2 || words[0].starts_with('-')) return usage();
  auto const made = concealed_arms::make_case(concealed_arms::parse_case(words[0]));
  concealed_arms::write_case(made, std::filesystem::path(words[1]) / made.of.folder);
  std::printf("%s  largest snr %.3g\n", made.of.folder.c_str(), made.left.largest_snr());
  return 0;
}

}  // namespace

int main(int argc, char** argv) try { return run({argv + 1, argv + argc}); } catch (std::exception const& problem) {
  std::fprintf(stderr, "make_arm_case: %s\n", problem.what());
  return 1;
}
