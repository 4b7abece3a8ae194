/// A vector of unknowns as NOX wants it.
#pragma once

#include <culm/assembly/tpetra.hpp>

#include <NOX_Abstract_Vector.H>

#include <utility>

namespace culm::solver {

/// Norms are over all ranks.
class NewtonVector final : public NOX::Abstract::Vector {
 public:
  explicit NewtonVector(const assembly::Rows& rows) : vector_(rows) {}
  explicit NewtonVector(assembly::Vector vector) : vector_(std::move(vector)) {}
  NewtonVector(const NewtonVector& other, NOX::CopyType type) : vector_(other.vector_.rows()) {
    if (type == NOX::DeepCopy) vector_ = other.vector_;
  }
  NewtonVector(const NewtonVector&) = delete;
  // the implicit operator would call the pure virtual one of the base
  NewtonVector& operator=(const NewtonVector& other) {
    vector_ = other.vector_;
    return *this;
  }
  NOX::Abstract::Vector& operator=(const NOX::Abstract::Vector& other) override {
    return *this = cast(other);
  }

  assembly::Vector& get() { return vector_; }
  const assembly::Vector& get() const { return vector_; }
  static const NewtonVector& cast(const NOX::Abstract::Vector& v) {
    return dynamic_cast<const NewtonVector&>(v);
  }

  NOX::Abstract::Vector& init(double gamma) override;
  NOX::Abstract::Vector& random(bool use_seed, int seed) override;
  NOX::Abstract::Vector& abs(const NOX::Abstract::Vector& y) override;
  NOX::Abstract::Vector& reciprocal(const NOX::Abstract::Vector& y) override;
  NOX::Abstract::Vector& scale(double gamma) override;
  NOX::Abstract::Vector& scale(const NOX::Abstract::Vector& a) override;
  NOX::Abstract::Vector& update(double alpha, const NOX::Abstract::Vector& a,
                                double gamma) override;
  NOX::Abstract::Vector& update(double alpha, const NOX::Abstract::Vector& a, double beta,
                                const NOX::Abstract::Vector& b, double gamma) override;
  Teuchos::RCP<NOX::Abstract::Vector> clone(NOX::CopyType type) const override;
  double norm(NormType type) const override;
  double norm(const NOX::Abstract::Vector& weights) const override;
  double innerProduct(const NOX::Abstract::Vector& y) const override;
  NOX::size_type length() const override;

 private:
  assembly::TpetraVector& own() { return assembly::tpetra(vector_); }
  const assembly::TpetraVector& own() const { return assembly::tpetra(vector_); }
  static const assembly::TpetraVector& own(const NOX::Abstract::Vector& v) { return cast(v).own(); }

  assembly::Vector vector_;
};

}  // namespace culm::solver
