/// Places along an element.
#pragma once

#include <span>

namespace culm {

/// Length along an element whose nodes need not be evenly spaced, by its natural coordinate:
/// s = integral of |dX/dxi|, the polynomial through its values at Gauss points. An element that is
/// even but for 1 % counts as even, such as those on curves.
class ArcLength {
 public:
  /// @param shares  of the length, of the points of gauss_legendre(shares.size()); they must
  /// outlive this [m]
  explicit ArcLength(std::span<const double> shares);

  double length() const { return length_; }
  /// |dX/dxi| [m]
  double rate(double xi) const;
  /// From the begin of the element up to xi in [-1, 1] [m].
  double at(double xi) const;
  /// Where that is so much; the ends for less than nothing and more than all.
  double xi_at(double length) const;

 private:
  std::span<const double> shares_;
  double length_ = 0.0;
  bool is_even_ = true;
};

}  // namespace culm
