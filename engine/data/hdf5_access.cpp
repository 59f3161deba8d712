#include "engine/data/hdf5_access.hpp"

#include <algorithm>
#include <functional>

namespace torquescope {
namespace {

constexpr std::size_t longest_text = std::size_t{1} << 16;  // PyTables keeps all names of a table in one
constexpr std::size_t most_letters = std::size_t{1} << 22;
constexpr hssize_t most_texts = 4096;

// read: fills memory of the given type
std::vector<std::string> texts_of(hid_t type, hid_t space, std::function<bool(hid_t, void*)> const& read) {
  if (H5Tget_class(type) != H5T_STRING) return {};
  hssize_t const count = H5Sget_simple_extent_npoints(space);
  if (count < 1 || count > most_texts) return {};
  std::vector<std::string> texts;
  if (H5Tis_variable_str(type) > 0) {
    Handle const memory(H5Tcopy(type), H5Tclose);
    std::vector<char*> pointers(static_cast<std::size_t>(count), nullptr);
    if (!read(memory.id(), pointers.data())) return {};
    for (char const* text : pointers) texts.emplace_back(text != nullptr ? text : "");
    H5Dvlen_reclaim(memory.id(), space, H5P_DEFAULT, pointers.data());
  } else {
    std::size_t const width = H5Tget_size(type);
    if (width == 0 || width > longest_text || static_cast<std::size_t>(count) > most_letters / width) return {};
    std::string letters(static_cast<std::size_t>(count) * width, '\0');
    if (!read(type, letters.data())) return {};
    for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) {
      auto const text = letters.substr(k * width, width);
      texts.push_back(text.substr(0, std::min(text.find('\0'), text.find_last_not_of(' ') + 1)));
    }
  }
  return texts;
}

}  // namespace

std::vector<std::string> text_attribute(hid_t object, char const* name) {
  if (H5Aexists(object, name) <= 0) return {};
  Handle const attribute(H5Aopen(object, name, H5P_DEFAULT), H5Aclose);
  Handle const type(attribute ? H5Aget_type(attribute.id()) : -1, H5Tclose);
  Handle const space(attribute ? H5Aget_space(attribute.id()) : -1, H5Sclose);
  if (!type || !space) return {};
  return texts_of(type.id(), space.id(),
                  [&](hid_t memory, void* target) { return H5Aread(attribute.id(), memory, target) >= 0; });
}

std::vector<std::string> text_dataset(hid_t group, std::string const& name) {
  H5L_info_t link{};
  bool const is_here = H5Lexists(group, name.c_str(), H5P_DEFAULT) > 0 &&
                       H5Lget_info(group, name.c_str(), &link, H5P_DEFAULT) >= 0 && link.type == H5L_TYPE_HARD;
  if (!is_here) return {};
  Handle const dataset(H5Dopen2(group, name.c_str(), H5P_DEFAULT), H5Dclose);
  Handle const type(dataset ? H5Dget_type(dataset.id()) : -1, H5Tclose);
  Handle const space(dataset ? H5Dget_space(dataset.id()) : -1, H5Sclose);
  Handle const creation(dataset ? H5Dget_create_plist(dataset.id()) : -1, H5Pclose);
  bool const within =
      creation && H5Pget_external_count(creation.id()) == 0 && H5Pget_layout(creation.id()) != H5D_VIRTUAL;
  if (!type || !space || !within) return {};
  return texts_of(type.id(), space.id(), [&](hid_t memory, void* target) {
    return H5Dread(dataset.id(), memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, target) >= 0;
  });
}

}  // namespace torquescope
