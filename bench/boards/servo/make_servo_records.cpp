// make_servo_records --seed S --out DIR ...: recordings, job and truth of one servo under several loads.
#include <exception>
#include <functional>
#include <iostream>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "servo/record_set.hpp"

namespace {

using Words = std::vector<std::string>;

char const* const usage =
    "usage: make_servo_records --seed S --out DIR [--with LAW ...] [--masses KG ...] [--unseen KG ...]\n"
    "                          [--lengths M ...] [--kps KP ...] [--motions N] [--seconds T] [--jitter S]\n"
    "  --with     laws that the servo has beside inertia, viscous and dry friction\n"
    "  --masses   of training (0.5 1.0); --unseen: of validation (0.75); --lengths (0.1 0.15); --kps (8 32)\n"
    "  --motions  of each load and gain (5), of T seconds (6); --jitter: greatest error of the clock's even times (0)\n"
    "  the same words make the same bytes\n";

double a_number(std::string const& word, double least, double most) {
  std::size_t used = 0;
  double x = 0.0;
  try {
    x = std::stod(word, &used);
  } catch (std::logic_error const&) {
  }
  if (used != word.size() || word.empty()) throw std::invalid_argument(word + " is no number");
  if (!(x >= least && x <= most))
    throw std::invalid_argument(word + " is not between " + std::to_string(least) + " and " + std::to_string(most));
  return x;
}

std::vector<double> numbers(Words const& words, double least, double most) {
  std::vector<double> all;
  for (auto const& word : words) all.push_back(a_number(word, least, most));
  return all;
}

void read(std::string const& option, Words const& words, servo::SetOptions& set, std::string& folder) {
  auto one = [&](double least, double most) {
    if (words.size() != 1) throw std::invalid_argument(option + " wants one number");
    return a_number(words.front(), least, most);
  };
  std::map<std::string, std::function<void()>> const options{
      {"--seed", [&] { set.seed = static_cast<std::uint64_t>(one(0.0, 9e15)); }},
      {"--out", [&] { folder = words.size() == 1 ? words.front() : ""; }},
      {"--with", [&] { set.with = words; }},
      {"--masses", [&] { set.masses = numbers(words, 0.0, 5.0); }},
      {"--unseen", [&] { set.validation_masses = numbers(words, 0.0, 5.0); }},
      {"--lengths", [&] { set.lengths = numbers(words, 0.01, 1.0); }},
      {"--kps", [&] { set.kps = numbers(words, 0.1, 1000.0); }},
      {"--motions", [&] { set.motions = static_cast<int>(one(1.0, 100.0)); }},
      {"--seconds", [&] { set.duration_s = one(1.0, 600.0); }},
      {"--jitter", [&] { set.jitter_s = one(0.0, 0.004); }},
  };
  auto const found = options.find(option);
  if (found == options.end()) throw std::invalid_argument("no option is called " + option);
  if (words.empty() && option != "--with") throw std::invalid_argument(option + " wants a value");
  found->second();
}

void run(Words const& words) {
  servo::SetOptions set;
  std::string folder;
  for (std::size_t k = 0; k < words.size();) {
    std::string const option = words[k++];
    Words values;
    while (k < words.size() && !words[k].starts_with("--")) values.push_back(words[k++]);
    read(option, values, set, folder);
  }
  if (folder.empty()) throw std::invalid_argument("--out is missing");
  servo::write_set(set, folder);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    if (argc == 2 && std::string{argv[1]} == "--help")
      std::cout << usage;
    else
      run({argv + 1, argv + argc});
    return 0;
  } catch (std::invalid_argument const& problem) {
    std::cerr << "make_servo_records: " << problem.what() << '\n' << usage;
    return 64;
  } catch (std::exception const& problem) {
    std::cerr << "make_servo_records: " << problem.what() << '\n';
    return 70;
  }
}
