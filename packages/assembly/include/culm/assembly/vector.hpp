/// Values of unknowns, spread over ranks by rows.
#pragma once

#include <culm/parallel/comm.hpp>

#include <cstddef>
#include <memory>
#include <optional>
#include <span>

namespace culm::assembly {

/// Which rows or columns of the equations a rank has, and their global numbers. Copies share one
/// map. What Tpetra has behind it is in tpetra.hpp, as for all types of this file.
class Rows {
 public:
  struct Stored;

  /// Those of this rank by their global numbers; where there is one rank, all of them in order.
  /// Collective.
  Rows(std::span<const long long> mine, const parallel::Comm& comm);
  explicit Rows(std::shared_ptr<const Stored> stored);

  std::size_t size() const;   ///< on this rank
  std::size_t total() const;  ///< on all ranks together
  long long global(std::size_t local) const;
  /// The place of a global number on this rank; none if it is elsewhere.
  std::optional<std::size_t> local(long long global) const;
  const Stored& stored() const { return *stored_; }

 private:
  std::shared_ptr<const Stored> stored_;
};

/// One number per row. Copies have values of their own.
class Vector {
 public:
  struct Stored;

  explicit Vector(const Rows& rows);  ///< zeros
  explicit Vector(std::unique_ptr<Stored> stored);
  Vector(const Vector& other);
  Vector(Vector&& other) noexcept;
  Vector& operator=(const Vector& other);  ///< of the same rows
  Vector& operator=(Vector&& other) noexcept;
  ~Vector();

  const Rows& rows() const { return rows_; }
  /// Those of this rank; valid as long as the vector.
  std::span<double> values() { return {data_, size_}; }
  std::span<const double> values() const { return {data_, size_}; }
  void fill(double value);
  /// Becomes own times itself plus factor times another one.
  void update(double factor, const Vector& other, double own = 1.0);
  void scale(double factor);
  double dot(const Vector& other) const;  ///< over all ranks, as what follows; collective
  double norm() const;                    ///< Euclidean
  double largest() const;                 ///< absolute value
  Stored& stored() { return *stored_; }
  const Stored& stored() const { return *stored_; }

 private:
  Rows rows_;
  std::unique_ptr<Stored> stored_;
  double* data_;
  std::size_t size_;
};

}  // namespace culm::assembly
