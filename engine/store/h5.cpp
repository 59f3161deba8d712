#include "engine/store/h5.hpp"

#include <hdf5.h>

#include <cerrno>
#include <cstdlib>
#include <string_view>

#include "engine/store/chunking.hpp"
#include "engine/store/h5_input_driver.hpp"
#include "engine/store/h5_output_driver.hpp"

namespace torquescope::h5 {
namespace {

// once per process: nothing printed, no filters loaded from folders that a file could name, and no tidying up at the
// exit: after a call to the disk has failed, HDF5 1.10 crashes there (handles close themselves, so there is nothing to
// tidy)
void prepare_library() {
  static bool const prepared = [] {
    H5dont_atexit();
    H5open();
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    H5PLset_loading_state(0);
    return true;
  }();
  static_cast<void>(prepared);
}

// what reading and writing share: results are published by rename, so locks protect nothing (and fail on some clusters)
Handle access_list() {
  Handle list = property_list(H5P_FILE_ACCESS);
  checked(H5Pset_file_locking(list.id(), 0, 1), "switch file locks off");
  checked(H5Pset_fclose_degree(list.id(), H5F_CLOSE_STRONG), "set the close degree");
  // only chunks that several runs share are touched twice (chunking.hpp); larger ones pass straight through
  constexpr std::size_t slots = 521;
  constexpr double evict_whole_chunks_first = 1.0;
  checked(H5Pset_cache(list.id(), 0, slots, shared_chunk_bytes, evict_whole_chunks_first), "size the chunk cache");
  return list;
}

}  // namespace

namespace {

// HDF5 tells errno in words alone: "file read failed: ..., errno = 5, error message = ..."
int error_number_in(std::string const& words) {
  std::string const lead = "errno = ";
  std::size_t const place = words.find(lead);
  return place == std::string::npos ? 0 : std::atoi(words.c_str() + place + lead.size());
}

}  // namespace

void fail(std::string const& doing) {
  std::string reason;
  auto const keep_innermost = [](unsigned depth, H5E_error2_t const* error, void* text) -> herr_t {
    if (depth == 0 && error->desc) *static_cast<std::string*>(text) = error->desc;
    return 0;
  };
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, keep_innermost, &reason);
  throw Failure(reason.empty() ? "HDF5 could not " + doing : reason, "", error_number_in(reason));
}

std::int64_t checked(std::int64_t result, char const* doing) {
  if (result < 0) fail(doing);
  return result;
}

void check_claimed_size(Handle const& object, double bytes) {
  Handle const file(checked(H5Iget_file_id(object.id()), "find the file"));
  hsize_t file_size = 0;
  checked(H5Fget_filesize(file.id(), &file_size), "read the file's size");
  constexpr double most_gzip_can = 1100;
  if (bytes > most_gzip_can * static_cast<double>(file_size))
    throw Failure("it claims more values than the file can hold");
}

bool Handle::close() noexcept {
  hid_t const id = std::exchange(id_, none);
  if (id < 0) return true;
  return (H5Iget_type(id) == H5I_FILE ? H5Fclose(id) : H5Idec_ref(id)) >= 0;
}

Handle property_list(std::int64_t kind) { return Handle(checked(H5Pcreate(kind), "prepare a property list")); }

Handle create_file(TempFile& file, ByteRanges& values) {
  prepare_library();
  Handle const access = access_list();
  checked(H5Pset_libver_bounds(access.id(), H5F_LIBVER_V110, H5F_LIBVER_V110), "choose the file version");
  // metadata of a larger file together, not in pieces of 2 KB all over it: each of them is a write of its own in the
  // end, into a page that was written past the cache and has to be read again
  constexpr std::uintmax_t larger = std::uintmax_t{1} << 20;
  constexpr hsize_t metadata_bytes = std::size_t{16} << 10;
  if (file.expected_bytes() >= larger)
    checked(H5Pset_meta_block_size(access.id(), metadata_bytes), "gather the metadata");
  if (!use_output_driver(access.id(), file, values)) fail("use the output driver");
  Handle const creation = property_list(H5P_FILE_CREATE);
  checked(H5Pset_obj_track_times(creation.id(), 0), "switch times off");
  return Handle(
      checked(H5Fcreate(file.final_name().c_str(), H5F_ACC_TRUNC, creation.id(), access.id()), "create the file"));
}

Handle open_file(ReadFile const& file) {
  prepare_library();
  Handle const access = access_list();
  if (!use_input_driver(access.id(), file)) fail("use the input driver");
  return Handle(checked(H5Fopen(file.path().c_str(), H5F_ACC_RDONLY, access.id()), "open the file"));
}

// its first bytes, or those behind a block of 512, 1024, 2048, ... that is another program's
bool is_hdf5(ReadFile const& file) {
  constexpr std::string_view letters = "\x89HDF\r\n\x1a\n";
  constexpr std::uint64_t smallest_block = 512;
  std::string found(letters.size(), '\0');
  for (std::uint64_t at = 0; at + letters.size() <= file.size(); at = at == 0 ? smallest_block : 2 * at)
    if (read_at(file.descriptor(), at, found.data(), found.size()) && found == letters) return true;
  return false;
}

void flush(Handle const& file) { checked(H5Fflush(file.id(), H5F_SCOPE_LOCAL), "write the file"); }

}  // namespace torquescope::h5
