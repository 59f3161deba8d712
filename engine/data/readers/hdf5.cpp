// HDF5 and MAT 7.3: every numeric dataset of rank 1 or 2, in any group.
//
// Names      the path without its leading slash: "joint_1/q"; a matrix (rows are samples) gives "name[0]", "name[1]",
//            ... or the names in its attribute `columns`. MATLAB stores transposed: known by the attribute MATLAB_class
// Refused    numbers in another file (external links and storage, virtual datasets); soft links are not followed;
//            filters that are not HDF5's own: none is loaded from this machine's folders
// Checked    type, rank, layout, and sizes against the bytes stored, before anything is allocated; the bytes parsed are
//            those of the sha256
// Confined   in a process of its own: of a hundred damaged files two crash HDF5 1.10 or keep it busy for ever
// Errors     Error 65 when the file is damaged or cut short
// Threads    one at a time
// Source     HDF5 1.10 C API; MATLAB 7.3: an HDF5 file behind 512 bytes of its own

#include <fmt/format.h>
#include <hdf5.h>

#include <algorithm>
#include <set>

#include "engine/base/digest.hpp"
#include "engine/base/error.hpp"
#include "engine/data/data_problem.hpp"
#include "engine/data/delimited_text.hpp"
#include "engine/data/file_bytes.hpp"
#include "engine/data/recording_reader.hpp"
#include "engine/data/table_builder.hpp"

namespace torquescope {
namespace {

constexpr std::string_view signature = "\x89HDF\r\n\x1a\n";
constexpr int deepest_group = 32;
constexpr std::size_t most_objects = 20000;
constexpr std::size_t longest_name = 1024;

// an identifier of the library, closed by the function that belongs to it
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  Handle(Handle const&) = delete;
  Handle& operator=(Handle const&) = delete;
  hid_t id() const { return id_; }
  explicit operator bool() const { return id_ >= 0; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

// the library prints its error stack unless told not to; our messages say what a user can use
class QuietErrors {
 public:
  QuietErrors() {
    H5Eget_auto2(H5E_DEFAULT, &print_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  ~QuietErrors() { H5Eset_auto2(H5E_DEFAULT, print_, data_); }
  QuietErrors(QuietErrors const&) = delete;
  QuietErrors& operator=(QuietErrors const&) = delete;

 private:
  H5E_auto2_t print_ = nullptr;
  void* data_ = nullptr;
};

bool accepts(std::filesystem::path const&, std::string const& first_bytes) {
  for (std::size_t at = 0; at < first_bytes.size(); at = at == 0 ? 512 : 2 * at)  // where the format allows it to begin
    if (std::string_view(first_bytes).substr(at).starts_with(signature)) return true;
  return false;
}

// the texts of a one-dimensional string attribute, or nothing
std::vector<std::string> text_attribute(hid_t object, char const* name) {
  if (H5Aexists(object, name) <= 0) return {};
  Handle const attribute(H5Aopen(object, name, H5P_DEFAULT), H5Aclose);
  Handle const type(attribute ? H5Aget_type(attribute.id()) : -1, H5Tclose);
  Handle const space(attribute ? H5Aget_space(attribute.id()) : -1, H5Sclose);
  if (!type || !space || H5Tget_class(type.id()) != H5T_STRING) return {};
  hssize_t const count = H5Sget_simple_extent_npoints(space.id());
  if (count < 1 || count > 4096) return {};
  std::vector<std::string> texts;
  if (H5Tis_variable_str(type.id()) > 0) {
    Handle const memory(H5Tcopy(type.id()), H5Tclose);
    std::vector<char*> pointers(static_cast<std::size_t>(count), nullptr);
    if (H5Aread(attribute.id(), memory.id(), pointers.data()) < 0) return {};
    for (char const* text : pointers) texts.emplace_back(text != nullptr ? text : "");
    H5Dvlen_reclaim(memory.id(), space.id(), H5P_DEFAULT, pointers.data());
  } else {
    std::size_t const width = H5Tget_size(type.id());
    if (width == 0 || width > longest_name) return {};
    std::string letters(static_cast<std::size_t>(count) * width, '\0');
    if (H5Aread(attribute.id(), type.id(), letters.data()) < 0) return {};
    for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) {
      auto const text = letters.substr(k * width, width);
      texts.push_back(text.substr(0, std::min(text.find('\0'), text.find_last_not_of(' ') + 1)));
    }
  }
  return texts;
}

class FileWalk {
 public:
  FileWalk(TableBuilder& table, hsize_t file_bytes) : table_(table), file_bytes_(file_bytes) {}

  void root(hid_t root) {
    H5O_info_t info{};
    if (H5Oget_info2(root, &info, H5O_INFO_BASIC) >= 0) seen_.insert(info.addr);
    group(root, "", 0);
  }

 private:
  void group(hid_t group, std::string const& prefix, int depth) {
    H5G_info_t info{};
    if (H5Gget_info(group, &info) < 0) return;
    for (hsize_t k = 0; k < info.nlinks; ++k) {
      auto const name = link_name(group, k);
      if (name.empty() || name.starts_with("#refs#") || ++n_objects_ > most_objects) continue;
      H5L_info_t link{};
      if (H5Lget_info(group, name.c_str(), &link, H5P_DEFAULT) < 0) continue;
      if (link.type == H5L_TYPE_HARD)
        object(group, name, prefix + name, depth);
      else
        table_.cannot_use(prefix + name, link.type == H5L_TYPE_EXTERNAL
                                             ? "is a link into another file; copy its numbers into this one"
                                             : "is a soft link; name the path it points to");
    }
  }

  static std::string link_name(hid_t group, hsize_t k) {
    auto const length = H5Lget_name_by_idx(group, ".", H5_INDEX_NAME, H5_ITER_INC, k, nullptr, 0, H5P_DEFAULT);
    if (length <= 0 || static_cast<std::size_t>(length) > longest_name) return {};
    std::string name(static_cast<std::size_t>(length) + 1, '\0');
    H5Lget_name_by_idx(group, ".", H5_INDEX_NAME, H5_ITER_INC, k, name.data(), name.size(), H5P_DEFAULT);
    name.pop_back();
    return name;
  }

  void object(hid_t parent, std::string const& name, std::string const& path, int depth) {
    Handle const opened(H5Oopen(parent, name.c_str(), H5P_DEFAULT), H5Oclose);
    if (!opened) {
      table_.cannot_use(path, "is damaged");
      return;
    }
    H5O_info_t info{};
    if (H5Oget_info2(opened.id(), &info, H5O_INFO_BASIC) < 0) return;
    bool const is_new = seen_.insert(info.addr).second;
    if (info.type == H5O_TYPE_GROUP && is_new && depth < deepest_group) group(opened.id(), path + "/", depth + 1);
    if (info.type == H5O_TYPE_DATASET) dataset(opened.id(), path);
  }

  // a filter that does not belong to HDF5 itself, or ""
  static std::string foreign_filter(hid_t creation) {
    for (int k = 0; k < H5Pget_nfilters(creation); ++k) {
      unsigned flags = 0, settings = 0;
      std::size_t n_values = 0;
      char name[64] = "";
      H5Z_filter_t const filter =
          H5Pget_filter2(creation, static_cast<unsigned>(k), &flags, &n_values, nullptr, sizeof(name), name, &settings);
      constexpr H5Z_filter_t last_of_hdf5 = H5Z_FILTER_SCALEOFFSET;
      if (filter < 1 || filter > last_of_hdf5) return fmt::format("{:.20} (filter {})", shown(name), filter);
    }
    return {};
  }

  // whether the bytes stored can hold so many numbers: a few bytes may claim any size, and unpack to nothing but zeros
  bool can_hold(hid_t dataset, hid_t creation, hid_t type, hsize_t const sizes[2]) const {
    constexpr double best_compression = 1032;  // of deflate
    double const stored = static_cast<double>(std::min<hsize_t>(H5Dget_storage_size(dataset), file_bytes_));
    double const claimed =
        static_cast<double>(sizes[0]) * static_cast<double>(sizes[1]) * static_cast<double>(H5Tget_size(type));
    return claimed <= stored * (H5Pget_layout(creation) == H5D_CHUNKED ? best_compression : 1.0);
  }

  // why a dataset cannot serve, or ""
  std::string objection(hid_t dataset, hid_t type, hid_t space) const {
    auto const kind = H5Tget_class(type);
    if (kind == H5T_STRING) return "is text";
    if (kind != H5T_INTEGER && kind != H5T_FLOAT) return "is not made of plain real numbers";
    int const rank = H5Sget_simple_extent_ndims(space);
    if (rank != 1 && rank != 2) return fmt::format("has rank {} (a signal has 1, a table of signals 2)", rank);
    Handle const creation(H5Dget_create_plist(dataset), H5Pclose);
    if (!creation) return "is damaged";
    if (H5Pget_external_count(creation.id()) != 0) return "keeps its numbers in another file; copy them into this one";
    if (H5Pget_layout(creation.id()) == H5D_VIRTUAL)
      return "is a virtual dataset over other files; copy its numbers into this one";
    if (auto const filter = foreign_filter(creation.id()); !filter.empty())
      return fmt::format("is packed by {}, which is not part of HDF5; store it with gzip", filter);
    hsize_t sizes[2] = {0, 1};
    H5Sget_simple_extent_dims(space, sizes, nullptr);
    if (!can_hold(dataset, creation.id(), type, sizes))
      return fmt::format("claims {} x {} numbers, far more than its bytes can hold", sizes[0], sizes[1]);
    return {};
  }

  void dataset(hid_t dataset, std::string const& path) {
    Handle const type(H5Dget_type(dataset), H5Tclose);
    Handle const space(H5Dget_space(dataset), H5Sclose);
    if (!type || !space) {
      table_.cannot_use(path, "is damaged");
      return;
    }
    auto reason = objection(dataset, type.id(), space.id());
    auto const matlab_class = text_attribute(dataset, "MATLAB_class");
    if (!matlab_class.empty() && (matlab_class[0] == "char" || matlab_class[0] == "cell")) reason = "is text";
    if (!reason.empty()) {
      table_.cannot_use(path, reason);
      return;
    }
    hsize_t sizes[2] = {0, 1};
    H5Sget_simple_extent_dims(space.id(), sizes, nullptr);
    if (sizes[0] == 0 || sizes[1] == 0) {
      table_.cannot_use(path, "is empty");
      return;
    }
    table_.reserve(sizes[0], sizes[1], path);
    std::vector<double> values(static_cast<std::size_t>(sizes[0] * sizes[1]));
    if (H5Dread(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0) {
      table_.cannot_use(path, "cannot be decoded: it is damaged");
      return;
    }
    bool const transposed = !matlab_class.empty();
    table_.add_matrix(path, values, static_cast<std::size_t>(sizes[transposed ? 1 : 0]),
                      static_cast<std::size_t>(sizes[transposed ? 0 : 1]), transposed,
                      text_attribute(dataset, "columns"));
  }

  TableBuilder& table_;
  hsize_t file_bytes_;
  std::set<haddr_t> seen_;  // groups can contain each other
  std::size_t n_objects_ = 0;
};

RawTable read(std::filesystem::path const& path) {
  std::string bytes = read_whole_file(path);
  QuietErrors const quiet;
  H5PLset_loading_state(0);
  TableBuilder table(path.string(), sha256_hex(bytes));
  // the file in memory: the numbers read are those that were hashed, and nothing is ever written
  Handle const access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_fapl_core(access.id(), std::size_t{1} << 20, 0);
  H5Pset_file_image(access.id(), bytes.data(), bytes.size());
  // under a name that nothing can have, being below a file: HDF5 refuses an image when it finds a file of its name
  Handle const file(H5Fopen((path / "image").c_str(), H5F_ACC_RDONLY, access.id()), H5Fclose);
  validate(static_cast<bool>(file), [&] {
    return bad_data(fmt::format("{} is a damaged HDF5 file, or was cut short", path.string()), path.string(), 0,
                    "copy it again; was the program that wrote it stopped before it closed the file?");
  });
  hsize_t const file_bytes = bytes.size();
  bytes = {};
  Handle const root(H5Gopen2(file.id(), "/", H5P_DEFAULT), H5Gclose);
  if (root) FileWalk(table, file_bytes).root(root.id());
  return std::move(table).finish();
}

}  // namespace

ReaderChoice hdf5_reader() {
  return {"hdf5", "HDF5 or MATLAB 7.3: numeric datasets of rank 1 or 2; column names are their paths", accepts, read,
          "HDF5"};
}

}  // namespace torquescope
