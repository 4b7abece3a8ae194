/// Numbers that may carry their derivatives by the ends of a segment at the end of a step.
#pragma once

#include <culm/math/types.hpp>

#include <unsupported/Eigen/AutoDiff>

namespace culm::water {

using Dual = Eigen::AutoDiffScalar<Vec6>;

template <class Number>
using Vector = Eigen::Matrix<Number, 3, 1>;

inline double value_of(double number) { return number; }
inline double value_of(const Dual& number) { return number.value(); }

inline Vec3 value_of(const Vec3& vector) { return vector; }
inline Vec3 value_of(const Vector<Dual>& vector) {
  return {vector[0].value(), vector[1].value(), vector[2].value()};
}

/// A function of two numbers of which value and slopes are known.
inline double chain(double value, double, double, double, double) { return value; }
inline Dual chain(double value, const Dual& x, double by_x, const Dual& y, double by_y) {
  return {value, Vec6(by_x * x.derivatives() + by_y * y.derivatives())};
}

template <class Number>
Number dot(const Vector<Number>& a, const Vector<Number>& b) {
  Number sum = a[0] * b[0];
  sum += a[1] * b[1];
  sum += a[2] * b[2];
  return sum;
}

template <class Number>
Number size_of(const Number& number) {
  return value_of(number) < 0.0 ? Number(-number) : number;
}

/// Linear from a to b.
template <class Number>
Number between(double a, double b, const Number& share) {
  return Number(a) + Number(b - a) * share;
}
template <class Number>
Vector<Number> between(const Vector<Number>& a, const Vector<Number>& b, const Number& share) {
  return a + share * (b - a);
}

}  // namespace culm::water
