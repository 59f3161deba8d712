// HDF5 and MAT 7.3: every numeric dataset of rank 1 or 2, structures of numbers and pandas frames, in any group.
//
// Names      the path without its leading slash: "joint_1/q"; "name[0]", ... of a matrix (rows are samples), or the
//            names in its attribute `columns`; "name/field"; "frame/name" of pandas (pandas_frame.hpp)
// Refused    numbers in another file (external links and storage, virtual datasets); soft links are not followed;
//            filters that are not HDF5's own: none is loaded from this machine's folders
// Checked    type, rank, layout, and sizes against the bytes stored, before anything is allocated
// Budget     most_objects; links are listed in one pass, since asking for the k-th walks over all before it
// Errors     Error 65 when the file is damaged or cut short
// Threads    one at a time, in a process of its own: of a hundred damaged files two crash HDF5 1.10
// Source     HDF5 1.10 C API; MATLAB 7.3 (transposed, attribute MATLAB_class): HDF5 behind 512 bytes of its own

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "engine/base/digest.hpp"
#include "engine/base/error.hpp"
#include "engine/data/data_problem.hpp"
#include "engine/data/delimited_text.hpp"
#include "engine/data/file_bytes.hpp"
#include "engine/data/hdf5_access.hpp"
#include "engine/data/hdf5_open_flags.hpp"
#include "engine/data/pandas_frame.hpp"
#include "engine/data/recording_reader.hpp"
#include "engine/data/table_builder.hpp"

namespace torquescope {
namespace {

constexpr std::string_view signature = "\x89HDF\r\n\x1a\n";
constexpr int deepest_group = 32;
constexpr std::size_t most_objects = 200000;  // two seconds: ten microseconds each, measured
constexpr std::size_t longest_name = 1024;

bool accepts(std::filesystem::path const&, std::string const& first_bytes) {
  for (std::size_t at = 0; at < first_bytes.size(); at = at == 0 ? 512 : 2 * at)  // where the format allows it to begin
    if (std::string_view(first_bytes).substr(at).starts_with(signature)) return true;
  return false;
}

class FileWalk {
 public:
  FileWalk(TableBuilder& table, hsize_t file_bytes) : table_(table), file_bytes_(file_bytes) {}

  void root(hid_t root) {
    H5O_info_t info{};
    if (H5Oget_info2(root, &info, H5O_INFO_BASIC) >= 0) seen_.insert(info.addr);
    group(root, "", 0);
    if (is_cut_ || n_datasets_ == 0)
      table_.remark(
          fmt::format("{} groups and {} datasets were looked at{}.", n_groups_, n_datasets_,
                      is_cut_ ? "; what comes behind them was not: copy the signals into a file of their own" : ""));
  }

 private:
  struct Link {
    std::string name;
    H5L_type_t type;
  };
  struct Listing {
    std::size_t room;
    std::vector<Link> links{};
    bool is_cut = false;
  };

  // no exception may leave it: HDF5 is C
  static herr_t note_link(hid_t, char const* name, H5L_info_t const* info, void* listing) noexcept {
    auto& [room, links, is_cut] = *static_cast<Listing*>(listing);
    if ((is_cut = links.size() == room)) return 1;
    try {
      links.push_back({name, info->type});
      return 0;
    } catch (std::exception const&) {
      return -1;
    }
  }

  static bool keeps_its_order(hid_t group) {
    Handle const creation(H5Gget_create_plist(group), H5Pclose);
    unsigned order = 0;
    return creation && H5Pget_link_creation_order(creation.id(), &order) >= 0 && (order & H5P_CRT_ORDER_INDEXED) != 0;
  }

  // those that the budget allows, in the order in which they were written where the file keeps it, else by name
  std::vector<Link> links_of(hid_t group) {
    Listing listing{most_objects - n_objects_};
    hsize_t from = 0;
    auto const index = keeps_its_order(group) ? H5_INDEX_CRT_ORDER : H5_INDEX_NAME;
    H5Literate(group, index, H5_ITER_INC, &from, note_link, &listing);
    n_objects_ += listing.links.size();
    is_cut_ = is_cut_ || listing.is_cut;
    return std::move(listing.links);
  }

  void group(hid_t group, std::string const& prefix, int depth) {
    ++n_groups_;
    bool const is_frame = is_fixed_frame(group);
    for (auto const& [name, type] : links_of(group)) {
      bool const is_index = name.starts_with("#refs#") || name.starts_with("_i_");  // of MATLAB, of PyTables
      if (name.empty() || name.size() > longest_name || is_index) continue;
      if (is_frame && holds_pandas_names(name)) continue;
      if (type == H5L_TYPE_HARD)
        object(group, name, prefix + name, depth,
               is_frame ? fixed_frame_names(group, name, prefix) : std::vector<std::string>{});
      else
        table_.cannot_use(prefix + name, type == H5L_TYPE_EXTERNAL
                                             ? "is a link into another file; copy its numbers into this one"
                                             : "is a soft link; name the path it points to");
    }
  }

  void object(hid_t parent, std::string const& name, std::string const& path, int depth,
              std::vector<std::string> const& names) {
    Handle const opened(H5Oopen(parent, name.c_str(), H5P_DEFAULT), H5Oclose);
    if (!opened) {
      table_.cannot_use(path, "is damaged");
      return;
    }
    H5O_info_t info{};
    if (H5Oget_info2(opened.id(), &info, H5O_INFO_BASIC) < 0) return;
    bool const is_new = seen_.insert(info.addr).second;
    if (info.type == H5O_TYPE_GROUP && is_new && depth < deepest_group) group(opened.id(), path + "/", depth + 1);
    if (info.type != H5O_TYPE_DATASET) return;
    ++n_datasets_;
    dataset(opened.id(), path, names);
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

  static bool is_number(hid_t type) {
    auto const kind = H5Tget_class(type);
    return kind == H5T_INTEGER || kind == H5T_FLOAT;
  }

  // as h5py and MATLAB store complex numbers
  static bool is_complex(hid_t type) {
    if (H5Tget_nmembers(type) != 2) return false;
    return H5Tget_member_index(type, "r") >= 0 || H5Tget_member_index(type, "real") >= 0;
  }

  // why a dataset cannot serve, or ""
  std::string objection(hid_t dataset, hid_t type, hid_t space) const {
    auto const kind = H5Tget_class(type);
    if (kind == H5T_STRING) return "is text";
    if (!is_number(type) && (kind != H5T_COMPOUND || is_complex(type))) return "is not made of plain real numbers";
    int const rank = H5Sget_simple_extent_ndims(space);
    if (kind == H5T_COMPOUND && rank != 1) return "is not a list of structures";
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

  void dataset(hid_t dataset, std::string const& path, std::vector<std::string> const& names) {
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
    if (H5Tget_class(type.id()) == H5T_COMPOUND) return structures(dataset, type.id(), path, sizes[0]);
    table_.reserve(sizes[0], sizes[1], path);
    std::vector<double> values(static_cast<std::size_t>(sizes[0] * sizes[1]));
    if (H5Dread(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0) {
      table_.cannot_use(path, "cannot be decoded: it is damaged");
      return;
    }
    bool const transposed = !matlab_class.empty();
    table_.add_matrix(path, values, static_cast<std::size_t>(sizes[transposed ? 1 : 0]),
                      static_cast<std::size_t>(sizes[transposed ? 0 : 1]), transposed,
                      names.empty() ? text_attribute(dataset, "columns") : names);
  }

  void structures(hid_t dataset, hid_t type, std::string const& path, hsize_t n_rows) {
    for (unsigned k = 0; k < static_cast<unsigned>(std::max(0, H5Tget_nmembers(type))); ++k) {
      char* const given = H5Tget_member_name(type, k);
      std::string const name = given != nullptr ? given : "";
      H5free_memory(given);
      Handle const member(H5Tget_member_type(type, k), H5Tclose);
      if (member && !name.empty()) field(dataset, member.id(), name, path + "/" + name, n_rows);
    }
  }

  // one number in each structure, or a short list of them
  void field(hid_t dataset, hid_t member, std::string const& name, std::string const& path, hsize_t n_rows) {
    constexpr hsize_t most_numbers = 4096;
    hsize_t count = 1;
    bool const is_list = H5Tget_class(member) == H5T_ARRAY && H5Tget_array_ndims(member) == 1;
    Handle const base(is_list ? H5Tget_super(member) : H5Tcopy(member), H5Tclose);
    if (is_list) H5Tget_array_dims2(member, &count);
    if (!base || !is_number(base.id()) || count < 1 || count > most_numbers)
      return table_.cannot_use(path, "is not made of plain real numbers");
    table_.reserve(n_rows, count, path);
    Handle const numbers(is_list ? H5Tarray_create2(H5T_NATIVE_DOUBLE, 1, &count) : H5Tcopy(H5T_NATIVE_DOUBLE),
                         H5Tclose);
    Handle const memory(H5Tcreate(H5T_COMPOUND, static_cast<std::size_t>(count) * sizeof(double)), H5Tclose);
    std::vector<double> values(static_cast<std::size_t>(n_rows * count));
    bool const read = H5Tinsert(memory.id(), name.c_str(), 0, numbers.id()) >= 0 &&
                      H5Dread(dataset, memory.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) >= 0;
    if (!read) return table_.cannot_use(path, "cannot be decoded: it is damaged");
    table_.add_matrix(path, values, static_cast<std::size_t>(n_rows), static_cast<std::size_t>(count), false,
                      is_list ? names_of_field(dataset, name, path) : std::vector<std::string>{});
  }

  // of a table of pandas, which gathers columns of one type in a field
  std::vector<std::string> names_of_field(hid_t dataset, std::string const& name, std::string const& path) {
    auto names = table_field_names(dataset, name);
    for (auto& column : names) column = path.substr(0, path.size() - name.size()) + column;
    if (names.empty() && name.starts_with("values_block_") && !is_numbering_told_) {
      table_.remark(
          fmt::format("\"{}\" is a table of pandas whose names of columns cannot be read: they are numbered; "
                      "to_hdf(..., format=\"fixed\") keeps them readable.",
                      path));
      is_numbering_told_ = true;
    }
    return names;
  }

  TableBuilder& table_;
  hsize_t file_bytes_;
  std::set<haddr_t> seen_;  // groups can contain each other
  std::size_t n_objects_ = 0, n_groups_ = 0, n_datasets_ = 0;
  bool is_cut_ = false, is_numbering_told_ = false;
};

RawTable read(std::filesystem::path const& path) {
  std::string bytes = read_whole_file(path);
  QuietErrors const quiet;
  H5PLset_loading_state(0);
  TableBuilder table(path.string(), sha256_hex(bytes));
  bool const left_open = clear_open_flags(bytes);
  // the file in memory: the numbers read are those that were hashed, and nothing is ever written
  Handle const access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_fapl_core(access.id(), std::size_t{1} << 20, 0);
  H5Pset_file_image(access.id(), bytes.data(), bytes.size());
  // under a name that nothing can have, being below a file: HDF5 refuses an image when it finds a file of its name
  Handle const file(H5Fopen((path / "image").c_str(), H5F_ACC_RDONLY, access.id()), H5Fclose);
  validate(static_cast<bool>(file), [&] {
    if (left_open)
      return bad_data(
          fmt::format("{} was left open by the program that wrote it, and not all of it is in the file", path.string()),
          path.string(), 0, "close the file in that program and copy it again, or try: h5clear -s -i FILE");
    return bad_data(fmt::format("{} is a damaged HDF5 file, or was cut short", path.string()), path.string(), 0,
                    "copy it again; was the program that wrote it stopped before it closed the file?");
  });
  if (left_open)
    table.remark(
        "The file is marked as open: the program that wrote it was stopped, or still writes. What it has saved is "
        "read.");
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
