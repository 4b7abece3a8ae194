#include "newton_vector.hpp"

#include <cmath>

namespace culm::solver {

NOX::Abstract::Vector& NewtonVector::init(double gamma) {
  vector_->putScalar(gamma);
  return *this;
}
NOX::Abstract::Vector& NewtonVector::random(bool, int) {
  vector_->randomize();
  return *this;
}
NOX::Abstract::Vector& NewtonVector::abs(const NOX::Abstract::Vector& y) {
  vector_->abs(cast(y).get());
  return *this;
}
NOX::Abstract::Vector& NewtonVector::reciprocal(const NOX::Abstract::Vector& y) {
  vector_->reciprocal(cast(y).get());
  return *this;
}
NOX::Abstract::Vector& NewtonVector::scale(double gamma) {
  vector_->scale(gamma);
  return *this;
}
NOX::Abstract::Vector& NewtonVector::scale(const NOX::Abstract::Vector& a) {
  vector_->elementWiseMultiply(1.0, cast(a).get(), *vector_, 0.0);
  return *this;
}
NOX::Abstract::Vector& NewtonVector::update(double alpha, const NOX::Abstract::Vector& a,
                                            double gamma) {
  vector_->update(alpha, cast(a).get(), gamma);
  return *this;
}
NOX::Abstract::Vector& NewtonVector::update(double alpha, const NOX::Abstract::Vector& a,
                                            double beta, const NOX::Abstract::Vector& b,
                                            double gamma) {
  vector_->update(alpha, cast(a).get(), beta, cast(b).get(), gamma);
  return *this;
}
Teuchos::RCP<NOX::Abstract::Vector> NewtonVector::clone(NOX::CopyType type) const {
  return Teuchos::rcp(new NewtonVector(*this, type));
}
double NewtonVector::norm(NormType type) const {
  if (type == MaxNorm) return vector_->normInf();
  return type == OneNorm ? vector_->norm1() : vector_->norm2();
}
double NewtonVector::norm(const NOX::Abstract::Vector& weights) const {
  assembly::Vector product(vector_->getMap());
  product.elementWiseMultiply(1.0, cast(weights).get(), *vector_, 0.0);
  return std::sqrt(product.dot(*vector_));
}
double NewtonVector::innerProduct(const NOX::Abstract::Vector& y) const {
  return vector_->dot(cast(y).get());
}
NOX::size_type NewtonVector::length() const {
  return static_cast<NOX::size_type>(vector_->getGlobalLength());
}

}  // namespace culm::solver
