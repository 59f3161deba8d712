#include "engine/experiment/stored_objects.hpp"

#include <fmt/format.h>

namespace torquescope {

Error contradiction(ResultReader const& reader, std::string const& object, std::string const& reason) {
  Problem problem;
  problem.code = ExitCode::bad_data;
  problem.what = fmt::format("{} contradicts itself in {}: {}", reader.name().string(), object, reason);
  problem.help = "delete it and run the job again";
  return Error(problem);
}

double StoredObjects::number(std::string const& object, std::string const& name) const {
  return reader_.find_attribute<double>(object, name).value_or(unknown);
}

std::int64_t StoredObjects::whole(std::string const& object, std::string const& name) const {
  return reader_.find_attribute<std::int64_t>(object, name).value_or(0);
}

std::string StoredObjects::text(std::string const& object, std::string const& name) const {
  return reader_.find_attribute<std::string>(object, name).value_or("");
}

std::vector<std::string> StoredObjects::texts(std::string const& object, std::string const& name) const {
  return reader_.find_attribute<std::vector<std::string>>(object, name).value_or(std::vector<std::string>{});
}

std::vector<double> StoredObjects::numbers(std::string const& path) const {
  return exists(path) ? reader_.numbers(path).values : std::vector<double>{};
}

std::vector<std::int64_t> StoredObjects::whole_numbers(std::string const& path) const {
  return exists(path) ? reader_.whole_numbers(path).values : std::vector<std::int64_t>{};
}

std::vector<std::string> StoredObjects::text_column(std::string const& path) const {
  return exists(path) ? reader_.texts(path) : std::vector<std::string>{};
}

std::vector<std::string> StoredObjects::numbered(std::string const& group, std::string const& prefix) const {
  std::vector<std::string> paths;
  for (int i = 1; exists(fmt::format("{}/{}_{}", group, prefix, i)); ++i)
    paths.push_back(fmt::format("{}/{}_{}", group, prefix, i));
  return paths;
}

}  // namespace torquescope
