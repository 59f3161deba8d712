// make_sticking_case SEED CASE clean|single FOLDER: recordings, job and truth of one case of the board.
#include <exception>
#include <iostream>
#include <limits>
#include <string>
#include <vector>

#include "sticking/case_writer.hpp"

namespace {

char const* const usage =
    "usage: make_sticking_case SEED CASE clean|single FOLDER\n"
    "  SEED, CASE  whole numbers from 0; the same three words make the same bytes\n"
    "  FOLDER      gets train.csv, validate.csv, job.toml and truth.json\n";

std::uint64_t whole_number(std::string const& word, std::uint64_t most) {
  if (word.empty() || word.size() > 19 || word.find_first_not_of("0123456789") != std::string::npos)
    throw std::invalid_argument(word + " is no whole number from 0");
  std::uint64_t const number = std::stoull(word);
  if (number > most) throw std::invalid_argument(word + " is more than " + std::to_string(most));
  return number;
}

int run(std::vector<std::string> const& words) {
  if (words.size() != 4) {
    std::cerr << usage;
    return 64;
  }
  auto const seed = whole_number(words[0], std::numeric_limits<std::uint64_t>::max());
  auto const number = whole_number(words[1], std::numeric_limits<std::uint32_t>::max());
  sticking::write_case(sticking::draw_case(seed, static_cast<std::uint32_t>(number), words[2]), words[3]);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run({argv + 1, argv + argc});
  } catch (std::invalid_argument const& problem) {
    std::cerr << "make_sticking_case: " << problem.what() << '\n' << usage;
    return 64;
  } catch (std::exception const& problem) {
    std::cerr << "make_sticking_case: " << problem.what() << '\n';
    return 70;
  }
}
