// make_case NAME OUT_DIR          writes a sealed case to OUT_DIR/NAME
// make_case --clean SEED OUT_DIR  writes a clean record to OUT_DIR/clean_SEED
// make_case --clean SEED LAW OUT_DIR   the same with another sticking law (sticking_law.hpp), to OUT_DIR/clean_SEED_LAW
// make_case --list                names of the sealed cases, one per line
// make_case --words               effects, families, parameters, units and axes the truths are written with, as JSON
// make_case --drawn NAME OUT_DIR  writes a drawn case (drawn_name.hpp) to OUT_DIR/FOLDER
// make_case --list-drawn TIER FROM..TO [SUITE]   names of drawn cases, for example T1 1..775, one per line; another
// SUITE
//                                (0 when not given) has other seeds throughout
// make_case --folders NAME...     folder of each drawn case, one per line
// Prints one line: seal, folder, realised effect size. Exit code 0; 64 usage; 1 with a message when it fails.
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <vector>

#include "concealed/case_writer.hpp"
#include "concealed/exact_case.hpp"

namespace {

int usage() {
  std::fputs(
      "usage: make_case NAME OUT_DIR | make_case --clean SEED [LAW] OUT_DIR | make_case --drawn NAME OUT_DIR\n"
      "       make_case --list | make_case --list-drawn TIER FROM..TO [SUITE] | make_case --folders NAME...\n"
      "       make_case --words\n",
      stderr);
  return 64;
}

bool is_number(std::string const& word) {
  return !word.empty() && word.find_first_not_of("0123456789") == std::string::npos;
}

int list_drawn(std::string const& tier, std::string const& stretch, std::string const& suite) {
  auto const dots = stretch.find("..");
  bool const good = tier.size() == 2 && tier[0] == 'T' && tier[1] >= '0' && tier[1] <= '7' &&
                    dots != std::string::npos && is_number(stretch.substr(0, dots)) &&
                    is_number(stretch.substr(dots + 2)) && is_number(suite) && suite.size() < 10;
  if (!good) return usage();
  std::uint64_t const from = std::stoull(stretch.substr(0, dots)), to = std::stoull(stretch.substr(dots + 2));
  if (from == 0 || to >= concealed::seeds_per_suite) return usage();
  for (std::uint64_t i = from; i <= to; ++i)
    std::printf("%s\n", concealed::listed_name(tier[1] - '0', i, std::stoull(suite)).text().c_str());
  return 0;
}

void write(concealed::ReportedCase const& made, std::filesystem::path const& out) {
  auto const& [one_case, report] = made;
  auto const folder = out / one_case.name;
  std::string const seal = concealed::write_case(one_case, report, folder);
  std::printf("%s  %s  snr_eff %.3f  torque share %.3f %%  step error %.2g of torque noise, %.2g of encoder rounding\n",
              seal.c_str(), (folder / "truth.json").string().c_str(), report.together.snr(),
              100.0 * report.together.torque_share(), report.step_error.torque, report.step_error.position);
}

void make(concealed::Case const& one_case, std::filesystem::path const& out) {
  write({one_case, concealed::report_case(one_case)}, out);
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
  if ((words.size() == 3 || words.size() == 4) && words[0] == "--clean") {
    if (!is_number(words[1])) return usage();
    make(concealed::clean_case(std::stoull(words[1]), words.size() == 4 ? words[2] : "coulomb"), words.back());
    return 0;
  }
  if ((words.size() == 3 || words.size() == 4) && words[0] == "--list-drawn")
    return list_drawn(words[1], words[2], words.size() == 4 ? words[3] : "0");
  if (words.size() == 3 && words[0] == "--drawn") {
    write(concealed::exact_case(concealed::parse_drawn_name(words[1])), words[2]);
    return 0;
  }
  if (words.size() > 1 && words[0] == "--folders") {
    for (std::size_t i = 1; i < words.size(); ++i) {
      std::printf("%s\n", concealed::parse_drawn_name(words[i]).folder().c_str());
    }
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
