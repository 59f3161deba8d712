// Groups and the paths that lead through them.

#include <hdf5.h>

#include <algorithm>

#include "engine/store/h5.hpp"

namespace torquescope::h5 {
namespace {

// "/runs/fade" -> {"runs", "fade"}
std::vector<std::string> steps_of(std::string const& path) {
  std::vector<std::string> steps;
  std::size_t begin = 0;
  while (begin < path.size()) {
    std::size_t const end = std::min(path.find('/', begin), path.size());
    if (end > begin) steps.push_back(path.substr(begin, end - begin));
    begin = end + 1;
  }
  return steps;
}

bool has_child(Handle const& group, std::string const& name) {
  if (!is_group(group)) return false;
  if (checked(H5Lexists(group.id(), name.c_str(), H5P_DEFAULT), "look up a name") == 0) return false;
  H5L_info_t info{};
  checked(H5Lget_info(group.id(), name.c_str(), &info, H5P_DEFAULT), "look up a link");
  if (info.type != H5L_TYPE_HARD) throw Failure("\"" + name + "\" is a link to elsewhere; results have none");
  return true;
}

Handle root_of(Handle const& file) {
  return Handle(checked(H5Oopen(file.id(), "/", H5P_DEFAULT), "open the root group"));
}

}  // namespace

Handle open_child(Handle const& group, std::string const& name) {
  if (!has_child(group, name)) throw Failure("there is no \"" + name + "\"");
  return Handle(checked(H5Oopen(group.id(), name.c_str(), H5P_DEFAULT), "open an object"));
}

bool exists(Handle const& file, std::string const& path) {
  Handle object = root_of(file);
  for (auto const& step : steps_of(path)) {
    if (!has_child(object, step)) return false;
    object = open_child(object, step);
  }
  return true;
}

Handle open_object(Handle const& file, std::string const& path) {
  Handle object = root_of(file);
  for (auto const& step : steps_of(path)) object = open_child(object, step);
  return object;
}

Handle make_groups(Handle const& file, std::string const& path) {
  Handle group = root_of(file);
  for (auto const& step : steps_of(path)) {
    if (has_child(group, step)) {
      group = open_child(group, step);
      continue;
    }
    Handle const creation = property_list(H5P_GROUP_CREATE);
    checked(H5Pset_obj_track_times(creation.id(), 0), "switch times off");
    group = Handle(
        checked(H5Gcreate2(group.id(), step.c_str(), H5P_DEFAULT, creation.id(), H5P_DEFAULT), "create a group"));
  }
  return group;
}

bool is_group(Handle const& object) { return H5Iget_type(object.id()) == H5I_GROUP; }

std::uint64_t address(Handle const& object) {
  H5O_info_t info{};
  checked(H5Oget_info2(object.id(), &info, H5O_INFO_BASIC), "find an object's address");
  return info.addr;
}

std::vector<std::string> child_names(Handle const& group) {
  std::vector<std::string> names;
  auto const collect = [](hid_t, char const* name, H5L_info_t const*, void* list) -> herr_t {
    static_cast<std::vector<std::string>*>(list)->emplace_back(name);
    return 0;
  };
  checked(H5Literate(group.id(), H5_INDEX_NAME, H5_ITER_NATIVE, nullptr, collect, &names), "list a group");
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace torquescope::h5
