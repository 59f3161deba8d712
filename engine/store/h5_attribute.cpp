#include <hdf5.h>

#include <algorithm>
#include <map>

#include "engine/base/contract.hpp"
#include "engine/store/h5.hpp"

namespace torquescope::h5 {
namespace {

Handle list_space(std::size_t count) {
  hsize_t const extent = count;
  return Handle(checked(H5Screate_simple(1, &extent, nullptr), "make a shape"));
}

Handle scalar_space() { return Handle(checked(H5Screate(H5S_SCALAR), "make a shape")); }

struct AttributeWriter {
  hid_t object;
  char const* name;

  void write(hid_t file_type, hid_t memory_type, Handle const& space, void const* values, std::size_t count) const {
    // written again: the new value replaces the old one
    if (checked(H5Aexists(object, name), "look up an attribute") > 0)
      checked(H5Adelete(object, name), "replace an attribute");
    Handle const attribute(
        checked(H5Acreate2(object, name, file_type, space.id(), H5P_DEFAULT, H5P_DEFAULT), "create an attribute"));
    if (count > 0) checked(H5Awrite(attribute.id(), memory_type, values), "write an attribute");
  }

  void operator()(std::int64_t value) const { write(H5T_STD_I64LE, H5T_NATIVE_INT64, scalar_space(), &value, 1); }
  void operator()(double value) const { write(H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, scalar_space(), &value, 1); }
  void operator()(std::string const& value) const {
    PaddedTexts const padded({&value, 1});
    Handle const type = text_type(padded.size_of_one);
    write(type.id(), type.id(), scalar_space(), padded.bytes.data(), 1);
  }
  void operator()(std::vector<double> const& values) const {
    write(H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, list_space(values.size()), values.data(), values.size());
  }
  void operator()(std::vector<std::string> const& values) const {
    PaddedTexts const padded(values);
    Handle const type = text_type(padded.size_of_one);
    write(type.id(), type.id(), list_space(values.size()), padded.bytes.data(), values.size());
  }
  // as_stored() leaves neither
  void operator()(bool) const { TORQUESCOPE_EXPECT(false); }
  void operator()(std::map<std::string, std::string> const&) const { TORQUESCOPE_EXPECT(false); }
};

struct AsStored {
  OptionValue operator()(bool value) const { return static_cast<std::int64_t>(value); }
  OptionValue operator()(std::string const& value) const { return value.substr(0, value.find_last_not_of('\0') + 1); }
  OptionValue operator()(std::vector<std::string> values) const {
    for (auto& value : values) value.erase(value.find_last_not_of('\0') + 1);
    return values;
  }
  OptionValue operator()(std::map<std::string, std::string> const& values) const {
    std::vector<std::string> lines;
    for (auto const& [key, value] : values) lines.push_back(key + " = " + value);
    return (*this)(std::move(lines));
  }
  template <class Value>
  OptionValue operator()(Value const& value) const {
    return value;
  }
};

OptionValue read_existing(Handle const& object, std::string const& name) {
  Handle const attribute(checked(H5Aopen(object.id(), name.c_str(), H5P_DEFAULT), "open an attribute"));
  Handle const type(checked(H5Aget_type(attribute.id()), "read an attribute's type"));
  Handle const space(checked(H5Aget_space(attribute.id()), "read an attribute's shape"));
  H5T_class_t const kind = H5Tget_class(type.id());
  std::int64_t const rank = checked(H5Sget_simple_extent_ndims(space.id()), "read an attribute's shape");
  auto const count = static_cast<std::size_t>(checked(H5Sget_simple_extent_npoints(space.id()), "count values"));
  bool const scalar = rank == 0 && count == 1;
  check_claimed_size(attribute, static_cast<double>(count) * static_cast<double>(H5Tget_size(type.id())));
  if (!scalar && rank != 1) throw Failure("it is neither one value nor a list");

  if (kind == H5T_STRING && H5Tis_variable_str(type.id()) == 0) {
    PaddedTexts padded(count, H5Tget_size(type.id()));
    Handle const memory = text_type(padded.size_of_one);
    if (count > 0) checked(H5Aread(attribute.id(), memory.id(), padded.bytes.data()), "read an attribute");
    auto texts = padded.texts();
    if (scalar) return std::move(texts[0]);
    return texts;
  }
  if (kind == H5T_INTEGER && scalar && H5Tget_size(type.id()) == sizeof(std::int64_t)) {
    std::int64_t value = 0;
    checked(H5Aread(attribute.id(), H5T_NATIVE_INT64, &value), "read an attribute");
    return value;
  }
  if (kind == H5T_FLOAT && H5Tget_size(type.id()) == sizeof(double)) {
    std::vector<double> values(count);
    if (count > 0) checked(H5Aread(attribute.id(), H5T_NATIVE_DOUBLE, values.data()), "read an attribute");
    if (scalar) return values[0];
    return values;
  }
  throw Failure("it has a type that results never have");
}

}  // namespace

OptionValue as_stored(OptionValue const& value) { return std::visit(AsStored{}, value); }

void write_attribute(Handle const& object, std::string const& name, OptionValue const& value) {
  std::visit(AttributeWriter{object.id(), name.c_str()}, as_stored(value));
}

std::optional<OptionValue> read_attribute(Handle const& object, std::string const& name) {
  if (checked(H5Aexists(object.id(), name.c_str()), "look up an attribute") == 0) return std::nullopt;
  try {
    return read_existing(object, name);
  } catch (Failure const& failure) {
    throw Failure("attribute \"" + name + "\": " + failure.what());
  }
}

std::vector<std::string> attribute_names(Handle const& object) {
  std::vector<std::string> names;
  auto const collect = [](hid_t, char const* name, H5A_info_t const*, void* list) -> herr_t {
    static_cast<std::vector<std::string>*>(list)->emplace_back(name);
    return 0;
  };
  hsize_t position = 0;
  checked(H5Aiterate2(object.id(), H5_INDEX_NAME, H5_ITER_NATIVE, &position, collect, &names), "list attributes");
  if (!is_group(object)) std::erase_if(names, is_about_scales);
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace torquescope::h5
