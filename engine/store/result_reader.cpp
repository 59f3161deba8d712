#include "engine/store/result_reader.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "engine/base/error.hpp"
#include "engine/store/disk_failure.hpp"
#include "engine/store/file_seal.hpp"
#include "engine/store/result_writer.hpp"

namespace torquescope {
namespace {

namespace fs = std::filesystem;

constexpr char run_again[] = "delete it and run the job again: the same command makes the same file";

Error refused(std::string what, std::string help) {
  return Error(Problem{.code = ExitCode::bad_data, .what = std::move(what), .help = std::move(help)});
}

Error damaged(fs::path const& name, std::string const& object, std::string const& reason) {
  std::string const where = object.empty() || object == "/" ? "" : " in " + object;
  return refused(fmt::format("{} is damaged{}: {}", name.string(), where, reason), run_again);
}

h5::Handle open_checked(ReadFile const& file) {
  auto const& name = file.path();
  if (check_seal(file) == Seal::broken) throw damaged(name, "", "its bytes do not match their sha256");
  try {
    return h5::open_file(file);
  } catch (h5::Failure const& failure) {
    if (failure.error_number() != 0) throw cannot_read(name, failure.error_number());
    if (h5::is_hdf5(file)) throw damaged(name, "", failure.what());
    throw refused(name.string() + " is not an HDF5 file",
                  "name a result file of torquescope run (or delete a damaged one)");
  }
}

template <class Value>
std::optional<Value> read_attribute_as(h5::Handle const& object, std::string const& name) {
  auto const value = h5::read_attribute(object, name);
  if (!value) return std::nullopt;
  OptionValue const wanted{Value{}};
  auto const fitting = converted(*value, wanted);
  if (!fitting)
    throw h5::Failure(fmt::format("attribute \"{}\" is a {}, not a {}", name, type_name(*value), type_name(wanted)));
  return std::get<Value>(*fitting);
}

h5::DatasetInfo describe_as(h5::Element element, h5::Handle const& dataset) {
  h5::DatasetInfo info = h5::describe(dataset);
  if (info.element != element) throw h5::Failure("it holds values of another type");
  return info;
}

template <class Array>
Array read_array(h5::Handle const& dataset, h5::Element element) {
  h5::DatasetInfo const info = describe_as(element, dataset);
  Array array{info.shape, {}};
  array.values.resize(info.rows() * info.values_per_row());
  h5::read_rows(dataset, info, 0, info.rows(), array.values.data());
  return array;
}

void expect_rows(h5::DatasetInfo const& info, std::size_t first, std::size_t count) {
  if (first > info.rows() || count > info.rows() - first) throw h5::Failure("it has fewer rows than it should");
}

template <class Value>
std::vector<Value> read_some_rows(h5::Handle const& dataset, h5::Element element, std::size_t first,
                                  std::size_t count) {
  h5::DatasetInfo const info = describe_as(element, dataset);
  expect_rows(info, first, count);
  std::vector<Value> values(count * info.values_per_row());
  h5::read_rows(dataset, info, first, count, values.data());
  return values;
}

template <class Value>
void read_into(h5::Handle const& dataset, h5::Element element, std::size_t first, std::size_t count,
               std::span<Value> to, std::size_t spare_bytes) {
  h5::DatasetInfo const info = describe_as(element, dataset);
  expect_rows(info, first, count);
  if (to.size() != count * info.values_per_row()) throw h5::Failure("its rows are not as wide as they should be");
  h5::read_rows(dataset, info, first, count, to.data(), spare_bytes);
}

}  // namespace

template <class Read>
auto ResultReader::guarded(std::string const& object, Read&& read) const {
  try {
    return read();
  } catch (h5::Failure const& failure) {
    if (failure.error_number() != 0) throw cannot_read(open_.path(), failure.error_number());
    throw damaged(open_.path(), failure.object().empty() ? object : failure.object(), failure.what());
  }
}

ResultReader::ResultReader(FilePlace const& place) : open_(place), file_(open_checked(open_)) {
  auto const format = find_attribute<std::int64_t>("/", "format");
  if (!format || !find_attribute<std::string>("/", "creator"))
    throw refused(
        open_.path().string() + " is an HDF5 file, but not a result of torquescope (it has no attribute \"format\")",
        "name a result file of torquescope run");
  if (*format > result_format)
    throw refused(
        fmt::format("{} has format {}; this version reads up to {}", open_.path().string(), *format, result_format),
        "use the version that wrote it, or a later one (attribute \"creator\" names it)");
  if (find_attribute<std::int64_t>("/", complete_key).value_or(0) != 1)
    throw refused(open_.path().string() + " was never finished", run_again);
}

h5::Handle const& ResultReader::object(std::string const& path) const {
  if (path == object_.path) return object_.handle;
  std::size_t const slash = path.rfind('/');
  bool const has_group = slash != std::string::npos && slash + 1 < path.size();
  std::string const group = has_group ? path.substr(0, std::max<std::size_t>(1, slash)) : "";
  object_ = {};
  if (!has_group) {
    object_ = {path, h5::open_object(file_, path)};
    return object_.handle;
  }
  if (group != group_.path) {
    group_ = {};
    group_ = {group, h5::open_object(file_, group)};
  }
  object_ = {path, h5::open_child(group_.handle, path.substr(slash + 1))};
  return object_.handle;
}

bool ResultReader::exists(std::string const& path) const {
  return guarded(path, [&] { return h5::exists(file_, path); });
}

std::vector<std::string> ResultReader::children(std::string const& group) const {
  return guarded(group, [&] {
    h5::Handle const& there = object(group);
    return h5::is_group(there) ? h5::child_names(there) : std::vector<std::string>();
  });
}

h5::DatasetInfo ResultReader::layout(std::string const& path) const {
  return guarded(path, [&] { return h5::describe(object(path)); });
}

h5::Shape ResultReader::shape(std::string const& path) const { return layout(path).shape; }

ResultReader::Numbers ResultReader::numbers(std::string const& path) const {
  return guarded(path, [&] { return read_array<Numbers>(object(path), h5::Element::number); });
}

ResultReader::WholeNumbers ResultReader::whole_numbers(std::string const& path) const {
  return guarded(path, [&] { return read_array<WholeNumbers>(object(path), h5::Element::whole_number); });
}

std::vector<double> ResultReader::number_rows(std::string const& path, std::size_t first, std::size_t count) const {
  return guarded(path, [&] { return read_some_rows<double>(object(path), h5::Element::number, first, count); });
}

std::vector<std::int64_t> ResultReader::whole_number_rows(std::string const& path, std::size_t first,
                                                          std::size_t count) const {
  return guarded(path,
                 [&] { return read_some_rows<std::int64_t>(object(path), h5::Element::whole_number, first, count); });
}

void ResultReader::read_rows(std::string const& path, std::size_t first, std::size_t count, std::span<double> to,
                             std::size_t spare_bytes) const {
  guarded(path, [&] { read_into(object(path), h5::Element::number, first, count, to, spare_bytes); });
}

void ResultReader::read_rows(std::string const& path, std::size_t first, std::size_t count, std::span<std::int64_t> to,
                             std::size_t spare_bytes) const {
  guarded(path, [&] { read_into(object(path), h5::Element::whole_number, first, count, to, spare_bytes); });
}

std::vector<std::string> ResultReader::texts(std::string const& path) const {
  return guarded(path, [&] {
    h5::Handle const& dataset = object(path);
    h5::DatasetInfo const info = describe_as(h5::Element::text, dataset);
    return h5::read_texts(dataset, info, 0, info.rows());
  });
}

std::vector<std::string> ResultReader::text_rows(std::string const& path, std::size_t first, std::size_t count) const {
  return guarded(path, [&] {
    h5::Handle const& dataset = object(path);
    h5::DatasetInfo const info = describe_as(h5::Element::text, dataset);
    expect_rows(info, first, count);
    return h5::read_texts(dataset, info, first, count);
  });
}

template <class Value>
std::optional<Value> ResultReader::find_attribute(std::string const& object_path, std::string const& name) const {
  return guarded(object_path, [&] { return read_attribute_as<Value>(object(object_path), name); });
}

template <class Value>
Value ResultReader::attribute(std::string const& object_path, std::string const& name) const {
  auto value = find_attribute<Value>(object_path, name);
  if (!value) throw damaged(open_.path(), object_path, "there is no attribute \"" + name + "\"");
  return *std::move(value);
}

template std::optional<double> ResultReader::find_attribute(std::string const&, std::string const&) const;
template std::optional<std::int64_t> ResultReader::find_attribute(std::string const&, std::string const&) const;
template std::optional<std::string> ResultReader::find_attribute(std::string const&, std::string const&) const;
template std::optional<std::vector<double>> ResultReader::find_attribute(std::string const&, std::string const&) const;
template std::optional<std::vector<std::string>> ResultReader::find_attribute(std::string const&,
                                                                              std::string const&) const;
template double ResultReader::attribute(std::string const&, std::string const&) const;
template std::int64_t ResultReader::attribute(std::string const&, std::string const&) const;
template std::string ResultReader::attribute(std::string const&, std::string const&) const;
template std::vector<double> ResultReader::attribute(std::string const&, std::string const&) const;
template std::vector<std::string> ResultReader::attribute(std::string const&, std::string const&) const;

std::vector<std::string> ResultReader::attribute_names(std::string const& object_path) const {
  return guarded(object_path, [&] { return h5::attribute_names(object(object_path)); });
}

std::string ResultReader::content_sha256() const { return attribute<std::string>("/", content_digest_key); }

ReadFacts ResultReader::read_everything(FilePart part) const {
  return guarded("/", [&] { return torquescope::read_everything(file_, part); });
}

ReadFacts ResultReader::verified_content() const {
  auto const format = attribute<std::int64_t>("/", "format");
  if (format < first_format_of_this_digest)
    throw refused(fmt::format("{} has format {}: its digest was taken in another way", open_.path().string(), format),
                  "run the job again to get a file whose content can be verified");
  ReadFacts found = read_everything(FilePart::content);
  if (found.sha256 != content_sha256()) throw damaged(open_.path(), "", "its content does not match its sha256");
  return found;
}

void ResultReader::expect_seal() const {
  if (find_attribute<std::int64_t>("/", sealed_key).value_or(0) == 1 && check_seal(open_) != Seal::whole)
    throw damaged(open_.path(), "", "its seal is missing: another program wrote into it, or its end is lost");
}

std::string ResultReader::verify() const {
  std::string sha256 = verified_content().sha256;
  expect_seal();
  return sha256;
}

std::string verify_result(fs::path const& name) { return ResultReader(name).verify(); }

}  // namespace torquescope
