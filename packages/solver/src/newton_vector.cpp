#include "newton_vector.hpp"

#include <cmath>

namespace culm::solver {

NOX::Abstract::Vector& NewtonVector::init(double gamma) {
  own().putScalar(gamma);
  return *this;
}
NOX::Abstract::Vector& NewtonVector::random(bool, int) {
  own().randomize();
  return *this;
}
NOX::Abstract::Vector& NewtonVector::abs(const NOX::Abstract::Vector& y) {
  own().abs(own(y));
  return *this;
}
NOX::Abstract::Vector& NewtonVector::reciprocal(const NOX::Abstract::Vector& y) {
  own().reciprocal(own(y));
  return *this;
}
NOX::Abstract::Vector& NewtonVector::scale(double gamma) {
  own().scale(gamma);
  return *this;
}
NOX::Abstract::Vector& NewtonVector::scale(const NOX::Abstract::Vector& a) {
  own().elementWiseMultiply(1.0, own(a), own(), 0.0);
  return *this;
}
NOX::Abstract::Vector& NewtonVector::update(double alpha, const NOX::Abstract::Vector& a,
                                            double gamma) {
  own().update(alpha, own(a), gamma);
  return *this;
}
NOX::Abstract::Vector& NewtonVector::update(double alpha, const NOX::Abstract::Vector& a,
                                            double beta, const NOX::Abstract::Vector& b,
                                            double gamma) {
  own().update(alpha, own(a), beta, own(b), gamma);
  return *this;
}
Teuchos::RCP<NOX::Abstract::Vector> NewtonVector::clone(NOX::CopyType type) const {
  return Teuchos::rcp(new NewtonVector(*this, type));
}
double NewtonVector::norm(NormType type) const {
  if (type == MaxNorm) return own().normInf();
  return type == OneNorm ? own().norm1() : own().norm2();
}
double NewtonVector::norm(const NOX::Abstract::Vector& weights) const {
  assembly::Vector product(vector_.rows());
  assembly::tpetra(product).elementWiseMultiply(1.0, own(weights), own(), 0.0);
  return std::sqrt(product.dot(vector_));
}
double NewtonVector::innerProduct(const NOX::Abstract::Vector& y) const {
  return own().dot(own(y));
}
NOX::size_type NewtonVector::length() const {
  return static_cast<NOX::size_type>(own().getGlobalLength());
}

}  // namespace culm::solver
