#include "engine/store/content_digest.hpp"

#include <algorithm>
#include <map>

#include "engine/base/digest.hpp"

namespace torquescope {
namespace {

bool is_about_the_file(std::string const& path, std::string const& attribute) {
  return path == "/" && (attribute == complete_key || attribute == content_digest_key);
}

void add_count(Digest& digest, std::uint64_t count) { digest.bytes(&count, sizeof(count)); }

void add_texts(Digest& digest, std::span<std::string const> texts) {
  for (auto const& text : texts) digest.text(text);
}

struct AddAttribute {
  Digest& digest;
  void operator()(bool) const {}                                       // never read: stored as a whole number
  void operator()(std::map<std::string, std::string> const&) const {}  // never read: stored as texts
  void operator()(std::int64_t value) const { digest.text("whole").bytes(&value, sizeof(value)); }
  void operator()(double value) const { digest.text("number").bytes(&value, sizeof(value)); }
  void operator()(std::string const& value) const { digest.text("text").text(value); }
  void operator()(std::vector<double> const& values) const {
    add_count(digest.text("numbers"), values.size());
    digest.numbers(values);
  }
  void operator()(std::vector<std::string> const& values) const {
    add_count(digest.text("texts"), values.size());
    add_texts(digest, values);
  }
};

void add_attributes(Digest& digest, h5::Handle const& object, std::string const& path) {
  for (auto const& name : h5::attribute_names(object)) {
    if (is_about_the_file(path, name)) continue;
    digest.text("attribute").text(name);
    if (auto const value = h5::read_attribute(object, name)) std::visit(AddAttribute{digest}, *value);
  }
}

// whole chunks at a time, so that each is read and checked once; few enough to stay in the processor's cache
std::size_t rows_at_once(h5::DatasetInfo const& info) {
  constexpr std::size_t block_bytes = std::size_t{256} << 10;
  std::size_t const value_bytes = std::max(info.text_size, sizeof(double));
  std::size_t const row_bytes = std::max<std::size_t>(1, info.values_per_row()) * value_bytes;
  std::size_t const chunk_rows = info.chunk.empty() ? 1 : info.chunk[0];
  return std::max<std::size_t>(1, block_bytes / row_bytes / chunk_rows) * chunk_rows;
}

template <class Number>
void add_rows(Digest& digest, h5::Handle const& dataset, h5::DatasetInfo const& info, std::size_t first,
              std::size_t count, std::vector<Number>& buffer) {
  buffer.resize(count * info.values_per_row());
  h5::read_rows(dataset, info, first, count, buffer.data());
  digest.bytes(buffer.data(), buffer.size() * sizeof(Number));
}

void add_dataset(Digest& digest, h5::Handle const& dataset) {
  static char const* const element_names[] = {"number", "whole", "text"};
  h5::DatasetInfo const info = h5::describe(dataset);
  digest.text("dataset").text(element_names[static_cast<int>(info.element)]);
  add_count(digest, info.shape.size());
  for (std::size_t extent : info.shape) add_count(digest, extent);

  std::vector<double> numbers;
  std::vector<std::int64_t> whole_numbers;
  std::size_t const step = rows_at_once(info);
  for (std::size_t first = 0; first < info.rows(); first += step) {
    std::size_t const count = std::min(step, info.rows() - first);
    switch (info.element) {
      case h5::Element::number:
        add_rows(digest, dataset, info, first, count, numbers);
        break;
      case h5::Element::whole_number:
        add_rows(digest, dataset, info, first, count, whole_numbers);
        break;
      case h5::Element::text:
        add_texts(digest, h5::read_texts(dataset, info, first, count));
        break;
    }
  }
}

void add_object(Digest& digest, h5::Handle const& file, std::string const& path) {
  if (path == "/provenance") return;
  std::vector<std::string> children;
  try {
    h5::Handle const object = h5::open_object(file, path);
    digest.text("object").text(path);
    add_attributes(digest, object, path);
    if (h5::is_group(object))
      children = h5::child_names(object);
    else
      add_dataset(digest, object);
  } catch (h5::Failure const& failure) {
    throw h5::Failure(failure.what(), path);
  }
  for (auto const& child : children) add_object(digest, file, (path == "/" ? path : path + "/") + child);
}

}  // namespace

std::string content_digest(h5::Handle const& file) {
  Digest digest;
  add_object(digest, file, "/");
  return digest.hex();
}

}  // namespace torquescope
