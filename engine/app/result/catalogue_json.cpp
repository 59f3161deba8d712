#include "engine/app/result/catalogue_json.hpp"

#include <nlohmann/json.hpp>

namespace torquescope {

namespace {

using Json = nlohmann::ordered_json;

Json head_json(CatalogueEntry const& entry) {
  return {{"name", entry.name}, {"kind", entry.kind}, {"title", entry.title}};
}

Json options_json(std::vector<OptionDescription> const& options) {
  Json list = Json::array();
  for (auto const& option : options)
    list.push_back({{"key", option.key},
                    {"type", option.type},
                    {"unit", option.unit},
                    {"range", option.range},
                    {"default", option.default_value},
                    {"meaning", option.meaning}});
  return list;
}

std::string document_of(Json entries) {
  Json const document = {{"schema", 1}, {"entries", std::move(entries)}};
  return document.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace

std::string list_json(std::vector<CatalogueEntry> const& entries) {
  Json list = Json::array();
  for (auto const& entry : entries) list.push_back(head_json(entry));
  return document_of(std::move(list));
}

std::string describe_json(std::vector<CatalogueEntry> const& entries) {
  Json list = Json::array();
  for (auto const& entry : entries) {
    list.push_back(head_json(entry));
    list.back()["text"] = entry.text;
    list.back()["options"] = options_json(entry.options);
  }
  return document_of(std::move(list));
}

}  // namespace torquescope
