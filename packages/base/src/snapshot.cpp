#include <culm/base/error.hpp>
#include <culm/base/snapshot.hpp>
#include <culm/base/text.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <utility>

namespace culm {
namespace {

using Take = std::function<void(std::string_view)>;

void put(std::uint64_t number, const Take& take) {
  take({reinterpret_cast<const char*>(&number), sizeof number});
}

void put(std::string_view text, const Take& take) {
  put(text.size(), take);
  take(text);
}

[[noreturn]] void fail() { throw FileError("the checkpoint is damaged"); }

std::uint64_t take_number(std::string_view& bytes) {
  std::uint64_t number = 0;
  if (bytes.size() < sizeof number) fail();
  std::memcpy(&number, bytes.data(), sizeof number);
  bytes.remove_prefix(sizeof number);
  return number;
}

std::string_view take_text(std::string_view& bytes) {
  const std::uint64_t length = take_number(bytes);
  if (bytes.size() < length) fail();
  const std::string_view text = bytes.substr(0, length);
  bytes.remove_prefix(length);
  return text;
}

// What lacks to a multiple of eight.
std::size_t rest_of_word(std::size_t length) { return (8 - length % 8) % 8; }

[[noreturn]] void miss(std::string_view name) {
  throw FileError("the checkpoint has no '" + std::string(name) + "'");
}

// What is longer has memory of its own.
constexpr std::size_t most_small = 256;

// Its length and its last letters, read at once where there are eight.
std::uint64_t mark_of(std::string_view name) {
  std::uint64_t mark = 0;
  if (name.size() >= sizeof mark) {
    std::memcpy(&mark, name.data() + name.size() - sizeof mark, sizeof mark);
  } else {
    for (const char letter : name) mark = mark << 8 | static_cast<unsigned char>(letter);
  }
  return mark ^ std::uint64_t{name.size()} << 56;
}

using Bits = std::array<std::uint64_t, 4>;
std::uint64_t bit_of(std::uint64_t mark) { return mark * 0x9e3779b97f4a7c15 >> 56; }
bool has_bit(const Bits& bits, std::uint64_t mark) {
  const std::uint64_t bit = bit_of(mark);
  return (bits[bit / 64] >> bit % 64 & 1) != 0;
}
void set_bit(Bits& bits, std::uint64_t mark) {
  const std::uint64_t bit = bit_of(mark);
  bits[bit / 64] |= std::uint64_t{1} << bit % 64;
}

}  // namespace

std::string_view Snapshot::name_of(const Entry& entry) const {
  return std::string_view(names_).substr(entry.name, entry.length);
}

std::span<const double> Snapshot::numbers_of(const Entry& entry) const {
  if (!entry.large.empty()) return entry.large;
  return std::span(small_).subspan(entry.first, entry.count);
}

std::size_t Snapshot::find(std::string_view name) const {
  const std::uint64_t mark = mark_of(name);
  std::size_t place = has_bit(seen_, mark) ? 0 : marks_.size();
  while (place < marks_.size() && (marks_[place] != mark || name_of(entries_[place]) != name)) {
    ++place;
  }
  return place;
}

Snapshot::Entry& Snapshot::make(std::string_view name) {
  const std::size_t known = find(name);
  if (known < entries_.size()) return entries_[known];
  if (entries_.empty()) {  // enough for a step of a small model
    entries_.reserve(48);
    marks_.reserve(48);
    names_.reserve(1024);
    small_.reserve(2 * most_small);
  }
  entries_.push_back({names_.size(), name.size(), 0, 0, {}});
  marks_.push_back(mark_of(name));
  set_bit(seen_, marks_.back());
  names_ += name;
  return entries_.back();
}

void Snapshot::set(std::string_view name, std::span<const double> numbers) {
  Entry& entry = make(name);
  if (numbers.size() > most_small) {
    entry.large.assign(numbers.begin(), numbers.end());
    return;
  }
  entry.large.clear();
  if (numbers.size() <= entry.count) {
    std::ranges::copy(numbers, small_.begin() + static_cast<std::ptrdiff_t>(entry.first));
  } else {
    entry.first = small_.size();
    small_.insert(small_.end(), numbers.begin(), numbers.end());
  }
  entry.count = numbers.size();
}

void Snapshot::set(std::string_view name, std::vector<double>&& numbers) {
  if (numbers.size() > most_small) {
    make(name).large = std::move(numbers);
  } else {
    set(name, std::span<const double>(numbers));
  }
}

void Snapshot::set(std::string_view name, std::initializer_list<double> numbers) {
  set(name, std::span<const double>(numbers.begin(), numbers.size()));
}

void Snapshot::set(std::string_view name, double number) {
  set(name, std::span<const double>(&number, 1));
}

void Snapshot::set_text(std::string_view name, std::string text) {
  const auto found = texts_.find(name);
  if (found != texts_.end()) {
    found->second = std::move(text);
  } else {
    texts_.emplace(name, std::move(text));
  }
}

std::span<const double> Snapshot::numbers(std::string_view name) const {
  const std::size_t place = find(name);
  if (place == entries_.size()) miss(name);
  return numbers_of(entries_[place]);
}

std::span<const double> Snapshot::numbers(std::string_view name, std::size_t count) const {
  const std::span<const double> found = numbers(name);
  if (found.size() != count) {
    throw FileError("the checkpoint has " + std::to_string(found.size()) + " numbers of '" +
                    std::string(name) + "', the model " + std::to_string(count));
  }
  return found;
}

std::vector<double> Snapshot::copy(std::string_view name) const {
  const std::span<const double> found = numbers(name);
  return {found.begin(), found.end()};
}

double Snapshot::number(std::string_view name) const { return numbers(name, 1).front(); }

int Snapshot::integer(std::string_view name) const {
  const double value = number(name);
  constexpr double most = std::numeric_limits<int>::max();
  if (!(std::abs(value) <= most) || value != std::trunc(value)) {
    throw FileError("the checkpoint has " + format_number(value) + " for '" + std::string(name) +
                    "', which is a whole number of at most " + format_number(most) + " either way");
  }
  return static_cast<int>(value);
}

const std::string& Snapshot::text(std::string_view name) const {
  const auto found = texts_.find(name);
  if (found == texts_.end()) miss(name);
  return found->second;
}

bool Snapshot::has(std::string_view name) const {
  return find(name) < entries_.size() || texts_.contains(name);
}

std::string Snapshot::encode() const {
  std::string bytes;
  encode([&](std::string_view piece) { bytes += piece; });
  return bytes;
}

void Snapshot::encode(const Take& sink) const {
  std::size_t length = 0;
  const Take take = [&](std::string_view piece) {
    length += piece.size();
    sink(piece);
  };
  std::vector<const Entry*> in_order;  // of the alphabet
  for (const Entry& entry : entries_) in_order.push_back(&entry);
  std::ranges::sort(in_order, {}, [this](const Entry* entry) { return name_of(*entry); });
  put(in_order.size(), take);
  for (const Entry* entry : in_order) {
    const std::span<const double> numbers = numbers_of(*entry);
    put(name_of(*entry), take);
    put(std::string_view(reinterpret_cast<const char*>(numbers.data()),
                         numbers.size() * sizeof(double)),
        take);
  }
  put(texts_.size(), take);
  for (const auto& [name, text] : texts_) {
    put(name, take);
    put(text, take);
  }
  put(tables_.size(), take);
  for (const Table& table : tables_) {
    put(table.name, take);
    put(table.rows * table.width, take);
  }
  take(std::string(rest_of_word(length), '\0'));
}

Snapshot Snapshot::decode(std::string_view bytes) {
  const std::size_t size = bytes.size();
  const auto take_numbers = [&](std::size_t length) {
    if (length % sizeof(double) != 0 || bytes.size() < length) fail();
    std::vector<double> numbers(length / sizeof(double));
    if (length > 0) std::memcpy(numbers.data(), bytes.data(), length);
    bytes.remove_prefix(length);
    return numbers;
  };
  Snapshot snapshot;
  for (std::uint64_t left = take_number(bytes); left > 0; --left) {
    const std::string name(take_text(bytes));
    snapshot.set(name, take_numbers(take_number(bytes)));
  }
  for (std::uint64_t left = take_number(bytes); left > 0; --left) {
    const std::string name(take_text(bytes));
    snapshot.set_text(name, std::string(take_text(bytes)));
  }
  std::vector<std::pair<std::string, std::size_t>> tables;
  for (std::uint64_t left = take_number(bytes); left > 0; --left) {
    std::string name(take_text(bytes));
    tables.emplace_back(std::move(name), take_number(bytes));
  }
  const std::size_t filling = rest_of_word(size - bytes.size());
  if (bytes.size() < filling) fail();
  bytes.remove_prefix(filling);
  for (const auto& [name, count] : tables) {
    if (count > bytes.size() / sizeof(double)) fail();
    snapshot.set(name, take_numbers(count * sizeof(double)));
  }
  if (!bytes.empty()) fail();
  return snapshot;
}

}  // namespace culm
