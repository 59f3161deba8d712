// Dimension scales: the attributes that H5DSset_scale and H5DSattach_scale of HDF5's high-level library leave, each
// written once. That library reads and writes them anew with every attachment, which leaves holes.

#include <hdf5.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "engine/store/h5.hpp"

namespace torquescope::h5 {
namespace {

constexpr char class_name[] = "CLASS", scale_name[] = "NAME", users_name[] = "REFERENCE_LIST",
               scales_name[] = "DIMENSION_LIST";

// one row of REFERENCE_LIST, without bytes that nobody set
struct User {
  hobj_ref_t dataset;
  std::int32_t dimension;
  std::int32_t padding;
};
static_assert(sizeof(User) == 16);

hobj_ref_t reference_to(Handle const& file, std::string const& path) {
  hobj_ref_t reference = 0;
  checked(H5Rcreate(&reference, file.id(), path.c_str(), H5R_OBJECT, -1), "refer to a dataset");
  return reference;
}

void write_list(Handle const& object, char const* name, Handle const& type, std::size_t count, void const* values) {
  hsize_t const extent = count;
  Handle const space(checked(H5Screate_simple(1, &extent, nullptr), "make a shape"));
  Handle const attribute(
      checked(H5Acreate2(object.id(), name, type.id(), space.id(), H5P_DEFAULT, H5P_DEFAULT), "create an attribute"));
  checked(H5Awrite(attribute.id(), type.id(), values), "write an attribute");
}

// ASCII that ends with NUL: HDF5 takes nothing else for a scale
void write_word(Handle const& object, char const* name, std::string const& word) {
  Handle const type(checked(H5Tcopy(H5T_C_S1), "make a text type"));
  checked(H5Tset_size(type.id(), word.size() + 1), "set a text's size");
  Handle const space(checked(H5Screate(H5S_SCALAR), "make a shape"));
  Handle const attribute(
      checked(H5Acreate2(object.id(), name, type.id(), space.id(), H5P_DEFAULT, H5P_DEFAULT), "create an attribute"));
  checked(H5Awrite(attribute.id(), type.id(), word.c_str()), "write an attribute");
}

Handle user_type() {
  Handle type(checked(H5Tcreate(H5T_COMPOUND, sizeof(User)), "make a type"));
  checked(H5Tinsert(type.id(), "dataset", offsetof(User, dataset), H5T_STD_REF_OBJ), "make a type");
  checked(H5Tinsert(type.id(), "dimension", offsetof(User, dimension), H5T_NATIVE_INT32), "make a type");
  return type;
}

}  // namespace

bool is_about_scales(std::string const& attribute) {
  constexpr std::array<std::string_view, 4> names{class_name, scale_name, users_name, scales_name};
  return std::find(names.begin(), names.end(), attribute) != names.end();
}

void make_scale(Handle const& file, std::string const& path, std::string const& name,
                std::vector<ScaleUse> const& uses) {
  Handle const scale = open_object(file, path);
  write_word(scale, class_name, "DIMENSION_SCALE");
  write_word(scale, scale_name, name);
  if (uses.empty()) return;
  std::vector<User> users;
  for (auto const& use : uses)
    users.push_back({reference_to(file, use.dataset), static_cast<std::int32_t>(use.dimension), 0});
  write_list(scale, users_name, user_type(), users.size(), users.data());
}

void write_scales(Handle const& file, std::string const& path, std::vector<std::string> const& scales) {
  std::vector<hobj_ref_t> references;
  for (auto const& scale : scales) references.push_back(reference_to(file, scale));
  std::vector<hvl_t> lists;
  for (auto& reference : references) lists.push_back({1, &reference});
  Handle const type(checked(H5Tvlen_create(H5T_STD_REF_OBJ), "make a type"));
  write_list(open_object(file, path), scales_name, type, lists.size(), lists.data());
}

}  // namespace torquescope::h5
