#include <culm/math/arc_length.hpp>
#include <culm/math/interpolation.hpp>

#include <algorithm>
#include <cmath>

namespace culm {
namespace {

constexpr double noticeable = 1e-2;  // of the mean rate

double rate_at_point(std::span<const double> shares, std::size_t k) {
  return shares[k] / gauss_legendre(static_cast<int>(shares.size()))[k].weight;
}

}  // namespace

ArcLength::ArcLength(std::span<const double> shares) : shares_(shares) {
  double least = rate_at_point(shares, 0);
  double largest = least;
  for (std::size_t k = 0; k < shares.size(); ++k) {
    length_ += shares[k];
    least = std::min(least, rate_at_point(shares, k));
    largest = std::max(largest, rate_at_point(shares, k));
  }
  is_even_ = largest - least <= noticeable * 0.5 * length_;
}

double ArcLength::rate(double xi) const {
  if (is_even_) return 0.5 * length_;
  const auto rule = gauss_legendre(static_cast<int>(shares_.size()));
  double sum = 0.0;
  for (std::size_t k = 0; k < rule.size(); ++k) {
    sum += rate_at_point(shares_, k) * lagrange(rule, k, xi);
  }
  return sum;
}

double ArcLength::at(double xi) const {
  if (is_even_) return 0.5 * (1.0 + xi) * length_;
  double sum = 0.0;
  for (const auto& [eta, weight] : gauss_legendre(static_cast<int>(shares_.size()))) {
    sum += 0.5 * (1.0 + xi) * weight * rate(-1.0 + 0.5 * (1.0 + xi) * (1.0 + eta));
  }
  return sum;
}

double ArcLength::xi_at(double length) const {
  const double even = 2.0 * length / length_ - 1.0;
  if (is_even_ || even <= -1.0 || even >= 1.0) return std::clamp(even, -1.0, 1.0);
  double low = -1.0;
  double high = 1.0;
  double xi = even;
  for (int i = 0; i < 60; ++i) {
    const double off = at(xi) - length;
    if (std::abs(off) <= 1e-15 * length_) break;
    (off > 0.0 ? high : low) = xi;
    xi -= off / rate(xi);
    if (!(xi > low && xi < high)) xi = 0.5 * (low + high);
  }
  return xi;
}

}  // namespace culm
