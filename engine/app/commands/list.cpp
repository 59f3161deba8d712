#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <memory>

#include "engine/app/commands/command.hpp"
#include "engine/app/result/catalogue_json.hpp"
#include "engine/app/terminal/plain_text.hpp"
#include "engine/app/terminal/table.hpp"
#include "engine/experiment/catalogue.hpp"

namespace torquescope {

namespace {

// in the order a job is thought about
std::vector<std::string> kinds_present() {
  std::vector<std::string> kinds{"section", "reader", "effect", "estimator", "optimiser", "loss"};
  for (auto const& entry : catalogue())
    if (std::find(kinds.begin(), kinds.end(), entry.kind) == kinds.end()) kinds.push_back(entry.kind);
  std::erase_if(kinds, [](std::string const& kind) {
    return std::none_of(catalogue().begin(), catalogue().end(), [&](auto const& entry) { return entry.kind == kind; });
  });
  return kinds;
}

std::string plural(std::string const& kind) { return kind == "loss" ? "losses" : kind + "s"; }

std::string kind_of_word(std::string const& word) {
  std::vector<std::string> words;
  for (auto const& kind : kinds_present()) {
    if (word == kind || word == plural(kind)) return kind;
    words.push_back(plural(kind));
  }
  Problem problem;
  problem.code = ExitCode::usage;
  problem.what = fmt::format("nothing is called \"{}\" here", word);
  if (std::string const close = closest_name(word, words); !close.empty())
    problem.what += fmt::format("; did you mean \"{}\"?", close);
  problem.help = fmt::format("torquescope list {}", fmt::join(words, "|"));
  throw Error(problem);
}

// "sections|readers|...", for shells
std::string kind_words() {
  std::vector<std::string> words;
  for (auto const& kind : kinds_present()) words.push_back(plural(kind));
  return fmt::format("{}", fmt::join(words, "|"));
}

ExitCode list_entries(std::string const& word, Session const& session) {
  std::vector<std::string> const kinds = word.empty() ? kinds_present() : std::vector<std::string>{kind_of_word(word)};
  std::vector<CatalogueEntry> listed;
  using Align = TextTable::Align;
  for (auto const& kind : kinds) {
    TextTable table({Align::left, Align::left}, "  ");
    for (auto const& entry : catalogue()) {
      if (entry.kind != kind) continue;
      table.row({entry.name, entry.title});
      listed.push_back(entry);
    }
    session.result(session.result_ink().bold(plural(kind)) + "\n" + table.text(page_width()));
  }
  session.document(list_json(listed));
  session.note("more: torquescope describe NAME\n");
  return ExitCode::ok;
}

}  // namespace

void add_list(CLI::App& app, ChosenCommand& chosen) {
  auto const word = std::make_shared<std::string>();
  CLI::App* command =
      app.add_subcommand("list", "Lists what a job can name: sections, readers, effects, estimators, losses.");
  command->footer(
      "  torquescope list\n"
      "  torquescope list effects\n"
      "  torquescope list effects --json - | jq -r .entries[].name\n");
  command->add_option("KIND", *word, "effects, laws, optimisers, readers, losses, estimators, sections, robots")
      ->type_name(kind_words());
  add_json_option(*command, chosen);
  add_colour_option(*command, chosen);
  command->callback(
      [word, &chosen] { chosen.work = [word](Session const& session) { return list_entries(*word, session); }; });
}

}  // namespace torquescope
