#include <culm/base/error.hpp>
#include <culm/base/snapshot.hpp>
#include <culm/base/text.hpp>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <utility>

namespace culm {
namespace {

void put(std::uint64_t number, std::string& bytes) {
  bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
}

void put(std::string_view text, std::string& bytes) {
  put(text.size(), bytes);
  bytes += text;
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

template <class Map>
const auto& find(const Map& map, const std::string& name) {
  const auto found = map.find(name);
  if (found == map.end()) throw FileError("the checkpoint has no '" + name + "'");
  return found->second;
}

}  // namespace

void Snapshot::set(const std::string& name, std::vector<double> numbers) {
  numbers_[name] = std::move(numbers);
}

void Snapshot::set(const std::string& name, double number) { numbers_[name] = {number}; }

void Snapshot::set_text(const std::string& name, std::string text) {
  texts_[name] = std::move(text);
}

const std::vector<double>& Snapshot::numbers(const std::string& name) const {
  return find(numbers_, name);
}

const std::vector<double>& Snapshot::numbers(const std::string& name, std::size_t count) const {
  const std::vector<double>& found = numbers(name);
  if (found.size() != count) {
    throw FileError("the checkpoint has " + std::to_string(found.size()) + " numbers of '" + name +
                    "', the model " + std::to_string(count));
  }
  return found;
}

double Snapshot::number(const std::string& name) const { return numbers(name, 1).front(); }

int Snapshot::integer(const std::string& name) const {
  const double value = number(name);
  constexpr double most = std::numeric_limits<int>::max();
  if (!(std::abs(value) <= most) || value != std::trunc(value)) {
    throw FileError("the checkpoint has " + format_number(value) + " for '" + name +
                    "', which is a whole number of at most " + format_number(most) + " either way");
  }
  return static_cast<int>(value);
}

const std::string& Snapshot::text(const std::string& name) const { return find(texts_, name); }

bool Snapshot::has(const std::string& name) const {
  return numbers_.count(name) + texts_.count(name) > 0;
}

std::string Snapshot::encode() const {
  std::string bytes;
  put(numbers_.size(), bytes);
  for (const auto& [name, numbers] : numbers_) {
    put(name, bytes);
    put(std::string_view(reinterpret_cast<const char*>(numbers.data()),
                         numbers.size() * sizeof(double)),
        bytes);
  }
  put(texts_.size(), bytes);
  for (const auto& [name, text] : texts_) {
    put(name, bytes);
    put(text, bytes);
  }
  return bytes;
}

Snapshot Snapshot::decode(std::string_view bytes) {
  Snapshot snapshot;
  for (std::uint64_t left = take_number(bytes); left > 0; --left) {
    const std::string name(take_text(bytes));
    const std::string_view raw = take_text(bytes);
    if (raw.size() % sizeof(double) != 0) fail();
    std::vector<double> numbers(raw.size() / sizeof(double));
    if (!raw.empty()) std::memcpy(numbers.data(), raw.data(), raw.size());
    snapshot.set(name, std::move(numbers));
  }
  for (std::uint64_t left = take_number(bytes); left > 0; --left) {
    const std::string name(take_text(bytes));
    snapshot.set_text(name, std::string(take_text(bytes)));
  }
  if (!bytes.empty()) fail();
  return snapshot;
}

}  // namespace culm
