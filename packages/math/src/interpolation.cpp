#include <culm/math/interpolation.hpp>

namespace culm {

double lagrange(std::span<const QuadraturePoint> rule, std::size_t k, double xi) {
  double value = 1.0;
  for (std::size_t j = 0; j < rule.size(); ++j) {
    if (j != k) value *= (xi - rule[j].xi) / (rule[k].xi - rule[j].xi);
  }
  return value;
}

}  // namespace culm
