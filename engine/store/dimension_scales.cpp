#include "engine/store/dimension_scales.hpp"

#include <algorithm>

#include "engine/base/contract.hpp"

namespace torquescope {
namespace {

std::string group_of(std::string const& path) { return path.substr(0, path.rfind('/')); }

bool is_scale(std::string const& path, std::vector<std::string> const& names) {
  return names.size() == 1 && group_of(path) + "/" + names.front() == path;
}

}  // namespace

void DimensionScales::add(std::string const& path, h5::Shape const& shape, std::vector<std::string> const& names) {
  if (names.empty() || std::find(shape.begin(), shape.end(), 0U) != shape.end()) return;
  TORQUESCOPE_EXPECT(names.size() == shape.size());
  datasets_[path] = {shape, names};
}

std::string DimensionScales::scale_of(std::string const& path, std::string const& name, std::size_t extent) const {
  for (std::string group = path; !group.empty();) {
    group = group_of(group);
    std::string scale = group + "/" + name;
    auto const found = datasets_.find(scale);
    if (found != datasets_.end() && is_scale(scale, found->second.names)) {
      TORQUESCOPE_EXPECT(found->second.shape.front() == extent);
      return scale;
    }
  }
  TORQUESCOPE_EXPECT(false);  // no scale of that name
  return {};
}

void DimensionScales::attach(h5::Handle const& file) const {
  std::map<std::string, std::vector<h5::ScaleUse>> uses;
  for (auto const& [path, dimensions] : datasets_)
    if (is_scale(path, dimensions.names)) uses[path];
  for (auto const& [path, dimensions] : datasets_) {
    if (uses.contains(path)) continue;
    std::vector<std::string> scales;
    for (std::size_t i = 0; i < dimensions.names.size(); ++i) {
      scales.push_back(scale_of(path, dimensions.names[i], dimensions.shape[i]));
      uses[scales.back()].push_back({path, i});
    }
    h5::write_scales(file, path, scales);
  }
  for (auto const& [scale, users] : uses) h5::make_scale(file, scale, datasets_.at(scale).names.front(), users);
}

}  // namespace torquescope
