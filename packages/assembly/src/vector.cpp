#include <culm/assembly/tpetra.hpp>

#include <Teuchos_DefaultMpiComm.hpp>
#include <Teuchos_DefaultSerialComm.hpp>

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

namespace culm::assembly {
namespace {

// Whether all numbers follow each other, from rank to rank.
bool are_in_order(std::span<const long long> mine, const parallel::Comm& comm) {
  std::vector<double> counts(static_cast<std::size_t>(comm.size()), 0.0);
  const auto before = counts.begin() + comm.rank();
  *before = static_cast<double>(mine.size());
  comm.sum(counts);
  auto next = static_cast<long long>(std::accumulate(counts.begin(), before, 0.0));
  const bool here = std::ranges::all_of(mine, [&](long long number) { return number == next++; });
  return comm.max(here ? 0 : 1) == 0;
}

Teuchos::RCP<const Map> make_map(std::span<const long long> mine, const parallel::Comm& comm) {
  const auto ranks = ranks_of(comm);
  // contiguous: what KLU2 wants
  if (comm.size() == 1) return Teuchos::rcp(new Map(mine.size(), 0, ranks));
  const auto sum = Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid();
  // it knows each of other numbers, and which rank has it
  if (are_in_order(mine, comm)) return Teuchos::rcp(new Map(sum, mine.size(), 0, ranks));
  const Teuchos::ArrayView<const GlobalIndex> numbers(
      mine.data(), static_cast<Teuchos::ArrayView<const GlobalIndex>::size_type>(mine.size()));
  return Teuchos::rcp(new Map(sum, numbers, 0, ranks));
}

}  // namespace

Teuchos::RCP<const Teuchos::Comm<int>> ranks_of(const parallel::Comm& comm) {
  if (comm.size() == 1) return Teuchos::rcp(new Teuchos::SerialComm<int>());
  return Teuchos::rcp(new Teuchos::MpiComm<int>(comm.handle()));
}

Rows::Rows(std::span<const long long> mine, const parallel::Comm& comm)
    : Rows(std::make_shared<const Stored>(make_map(mine, comm))) {}

Rows::Rows(std::shared_ptr<const Stored> stored) : stored_(std::move(stored)) {}

std::size_t Rows::size() const { return stored_->map->getNodeNumElements(); }

std::size_t Rows::total() const { return stored_->map->getGlobalNumElements(); }

long long Rows::global(std::size_t local) const {
  return stored_->map->getGlobalElement(static_cast<int>(local));
}

std::optional<std::size_t> Rows::local(long long global) const {
  const int found = stored_->map->getLocalElement(global);
  if (found < 0) return {};
  return static_cast<std::size_t>(found);
}

// Tpetra asks at each access who else looks at the values; with one memory space they stay where
// they are.
Vector::Vector(std::unique_ptr<Stored> stored)
    : rows_(rows_of(stored->vector.getMap())),
      stored_(std::move(stored)),
      data_(values_of(stored_->vector).data()),
      size_(stored_->vector.getLocalLength()) {}

Vector::Vector(const Rows& rows) : Vector(std::make_unique<Stored>(TpetraVector(tpetra(rows)))) {}

Vector::Vector(const Vector& other) : Vector(other.rows_) { *this = other; }
Vector::Vector(Vector&& other) noexcept = default;
Vector& Vector::operator=(Vector&& other) noexcept = default;
Vector::~Vector() = default;

Vector& Vector::operator=(const Vector& other) {
  std::ranges::copy(other.values(), data_);
  return *this;
}

void Vector::fill(double value) { std::ranges::fill(values(), value); }

void Vector::update(double factor, const Vector& other, double own) {
  const auto more = other.values();
  for (std::size_t i = 0; i < size_; ++i) data_[i] = own * data_[i] + factor * more[i];
}

void Vector::scale(double factor) {
  for (double& value : values()) value *= factor;
}

double Vector::dot(const Vector& other) const { return tpetra(*this).dot(tpetra(other)); }

double Vector::norm() const { return stored_->vector.norm2(); }

double Vector::largest() const { return stored_->vector.normInf(); }

}  // namespace culm::assembly
