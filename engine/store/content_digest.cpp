#include "engine/store/content_digest.hpp"

#include <algorithm>
#include <cstring>

#include "engine/base/contract.hpp"
#include "engine/base/digest_batch.hpp"

namespace torquescope {
namespace {

// more of one size is not worth the memory, a longer block not the copy
constexpr std::size_t most_waiting_bytes = std::size_t{1} << 21, most_copied_bytes = std::size_t{1} << 18;

// how many blocks of a size shall wait for each other
std::size_t together(std::size_t bytes) {
  std::size_t const most = texts_side_by_side();
  return most * bytes <= most_waiting_bytes ? most : 2;
}

// values that somebody will change: as they are now
std::shared_ptr<std::byte const> copy_of(std::span<std::byte const> values) {
  std::shared_ptr<std::byte[]> const copy(new std::byte[values.size()]);
  std::copy(values.begin(), values.end(), copy.get());
  return {copy, copy.get()};
}

bool is_about_the_file(std::string const& path, std::string const& attribute) {
  return path == "/" &&
         (attribute == complete_key || attribute == content_digest_key || attribute == provenance_digest_key);
}

void add_count(Digest& digest, std::uint64_t count) { digest.bytes(&count, sizeof(count)); }

void add_texts(Digest& digest, std::span<std::string const> texts) {
  for (auto const& text : texts) digest.text(text);
}

struct AddAttribute {
  Digest& digest;
  void operator()(bool) const { TORQUESCOPE_EXPECT(false); }                                       // as_stored()
  void operator()(std::map<std::string, std::string> const&) const { TORQUESCOPE_EXPECT(false); }  // as_stored()
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

}  // namespace

bool is_volatile(std::string const& path) {
  return path == provenance_path || path.starts_with(std::string(provenance_path) + "/");
}

std::size_t bytes_of_row(h5::Shape const& shape) {
  std::size_t bytes = sizeof(double);
  for (std::size_t i = 1; i < shape.size(); ++i) bytes *= shape[i];
  return bytes;
}

std::size_t rows_of_block(h5::Element element, h5::Shape const& shape) {
  std::size_t const rows = shape.empty() ? 1 : std::max<std::size_t>(1, shape[0]);
  if (element == h5::Element::text) return rows;
  return std::max<std::size_t>(1, digest_block_bytes / std::max(sizeof(double), bytes_of_row(shape)));
}

std::size_t blocks_of(h5::Element element, h5::Shape const& shape) {
  if (std::find(shape.begin(), shape.end(), 0U) != shape.end()) return 0;
  std::size_t const rows = shape.empty() ? 1 : shape[0];
  std::size_t const step = rows_of_block(element, shape);
  return (rows + step - 1) / step;
}

ContentDigest::Object& ContentDigest::object(std::string const& path) {
  auto const known = objects_.find(path);
  if (known != objects_.end()) return known->second;
  objects_.try_emplace("/");
  for (std::size_t slash = path.find('/', 1); slash != std::string::npos; slash = path.find('/', slash + 1))
    objects_.try_emplace(path.substr(0, slash));
  return objects_[path];
}

void ContentDigest::group(std::string const& path) { object(path); }

void ContentDigest::attribute(std::string const& path, std::string const& name, OptionValue const& value) {
  if (is_about_the_file(path, name)) return;
  Digest digest;
  std::visit(AddAttribute{digest}, value);
  object(path).attributes[name] = digest.raw();
}

void ContentDigest::dataset(std::string const& path, h5::Element element, h5::Shape const& shape) {
  static char const* const names[] = {"number", "whole", "text"};
  Object& dataset = object(path);
  dataset.element = names[static_cast<int>(element)];
  dataset.shape = shape;
  dataset.blocks.resize(blocks_of(element, shape));
}

bool ContentDigest::has_dataset(std::string const& path) const {
  auto const known = objects_.find(path);
  return known != objects_.end() && !known->second.element.empty();
}

ContentDigest::Waiting& ContentDigest::waiting_of_size(std::size_t bytes) {
  for (auto& waiting : waiting_)
    if (waiting.bytes == bytes) return waiting;
  // no other of the size that has waited longest may ever come
  auto const older = [](Waiting const& a, Waiting const& b) { return a.number < b.number; };
  Waiting& oldest = *std::min_element(waiting_.begin(), waiting_.end(), older);
  digest_waiting(oldest);
  oldest.bytes = bytes;
  return oldest;
}

void ContentDigest::block(std::string const& path, std::size_t index, std::span<std::byte const> values,
                          std::shared_ptr<void const> owner) {
  Object& dataset = object(path);
  TORQUESCOPE_EXPECT(index < dataset.blocks.size());
  if (2 * values.size() > most_waiting_bytes || (!owner && values.size() > most_copied_bytes)) {
    dataset.blocks[index] = Digest().bytes(values.data(), values.size()).raw();
    return;
  }
  Waiting& waiting = waiting_of_size(values.size());
  waiting.number = ++n_waited_;
  if (owner) {
    waiting.blocks.push_back({path, index, values.data(), std::move(owner)});
  } else {
    auto copy = copy_of(values);
    std::byte const* const first = copy.get();
    waiting.blocks.push_back({path, index, first, std::move(copy)});
  }
  if (waiting.blocks.size() >= together(values.size())) digest_waiting(waiting);
}

void ContentDigest::blocks(std::string const& path, std::size_t first_index, std::span<std::byte const> values,
                           std::size_t block_bytes) {
  Object& dataset = object(path);
  std::size_t const n_blocks = values.size() / block_bytes;
  TORQUESCOPE_EXPECT(values.size() % block_bytes == 0 && first_index + n_blocks <= dataset.blocks.size());
  auto const block_at = [&](std::size_t i) { return values.subspan(i * block_bytes, block_bytes); };
  auto const repeats = [&](std::size_t i) {
    return i > 0 && std::memcmp(block_at(i).data(), block_at(i - 1).data(), block_bytes) == 0;
  };
  std::vector<std::size_t> repeating, others;
  for (std::size_t i = 0; i < n_blocks; ++i) (repeats(i) ? repeating : others).push_back(i);
  // a single one may as well wait for the next, unless others repeat it
  if (others.size() == 1 && repeating.empty()) return block(path, first_index, values);
  std::vector<std::byte const*> texts;
  for (std::size_t const i : others) texts.push_back(block_at(i).data());
  std::vector<Sha256> digests(texts.size());
  sha256_of_each(texts, block_bytes, digests.data());
  Sha256* const first = dataset.blocks.data() + first_index;
  for (std::size_t i = 0; i < others.size(); ++i) first[others[i]] = digests[i];
  for (std::size_t const i : repeating) first[i] = first[i - 1];
}

void ContentDigest::digest_waiting(Waiting& waiting) {
  std::vector<std::byte const*> texts;
  for (auto const& block : waiting.blocks) texts.push_back(block.values);
  std::vector<Sha256> digests(texts.size());
  sha256_of_each(texts, waiting.bytes, digests.data());
  for (std::size_t i = 0; i < digests.size(); ++i) {
    auto const& block = waiting.blocks[i];
    object(block.path).blocks[block.index] = digests[i];
  }
  waiting.blocks.clear();
}

void ContentDigest::texts(std::string const& path, std::span<std::string const> texts) {
  Object& dataset = object(path);
  TORQUESCOPE_EXPECT(dataset.blocks.size() == 1);
  Digest digest;
  add_texts(digest, texts);
  dataset.blocks[0] = digest.raw();
}

std::string ContentDigest::hex(FilePart part) {
  for (auto& waiting : waiting_) digest_waiting(waiting);
  Digest digest;
  for (auto const& [path, object] : objects_) {
    if (is_volatile(path) != (part == FilePart::provenance)) continue;
    digest.text("object").text(path);
    for (auto const& [name, value] : object.attributes)
      digest.text("attribute").text(name).bytes(value.data(), value.size());
    if (object.element.empty()) continue;
    add_count(digest.text("dataset").text(object.element), object.shape.size());
    for (std::size_t extent : object.shape) add_count(digest, extent);
    for (auto const& block : object.blocks) digest.bytes(block.data(), block.size());
  }
  return digest.hex();
}

ArrayDigest::ArrayDigest(ContentDigest& digest, std::string path, h5::Element element, h5::Shape const& shape)
    : digest_(digest), path_(std::move(path)), block_bytes_(rows_of_block(element, shape) * bytes_of_row(shape)) {}

void ArrayDigest::add(std::span<std::byte const> values) {
  while (!values.empty()) {
    if (begun_.empty() && values.size() >= block_bytes_) {
      std::size_t const n_whole = values.size() / block_bytes_;
      digest_.blocks(path_, index_, values.first(n_whole * block_bytes_), block_bytes_);
      index_ += n_whole;
      values = values.subspan(n_whole * block_bytes_);
      continue;
    }
    auto const part = values.first(std::min(block_bytes_ - begun_.size(), values.size()));
    values = values.subspan(part.size());
    begun_.insert(begun_.end(), part.begin(), part.end());
    if (begun_.size() == block_bytes_) end();
  }
}

void ArrayDigest::end() {
  if (begun_.empty()) return;
  digest_.block(path_, index_++, begun_);
  begun_.clear();
}

}  // namespace torquescope
