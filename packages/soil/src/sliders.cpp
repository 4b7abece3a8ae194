#include <culm/soil/sliders.hpp>

#include <limits>

namespace culm::soil {

std::optional<std::vector<Slider>> sliders_of(const Curve& curve) {
  const std::vector<double> knots = curve.knots();
  if (knots.empty()) {
    return std::vector<Slider>{{curve.slope(0.0), std::numeric_limits<double>::infinity()}};
  }
  std::vector<double> slopes;
  double y = 0.0;
  for (const double knot : knots) {
    slopes.push_back((curve.force(knot) - curve.force(y)) / (knot - y));
    y = knot;
  }
  slopes.push_back(0.0);
  std::vector<Slider> sliders;
  const double rounding = 1e-12 * slopes.front();
  for (std::size_t i = 0; i < knots.size(); ++i) {
    const double stiffness = slopes[i] - slopes[i + 1];
    if (stiffness < -rounding || slopes[i] < -rounding) return {};
    if (stiffness > rounding) sliders.push_back({stiffness, stiffness * knots[i]});
  }
  return sliders;
}

// With e = u - slip: a slider at its limit that is not moved on is elastic, so that slopes about a
// state are those of a motion that turns.
SliderResponse slide(std::span<const Slider> sliders, const Vec3& prev, const Vec3& next,
                     double theta, std::span<Vec3> slips) {
  constexpr double rounding = 1e-13;
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  SliderResponse response;
  for (std::size_t i = 0; i < sliders.size(); ++i) {
    const auto& [k, limit] = sliders[i];
    const Vec3 before = prev - slips[i];
    const Vec3 trial = next - slips[i];
    const double size = trial.norm();
    Vec3 after = trial;
    Mat3 derivative = Mat3::Identity();
    // the elastic way is a small difference of large ones where much has slid
    const double lost = 4.0 * epsilon * (next.norm() + slips[i].norm());
    if (k * (size - lost) > limit * (1.0 + rounding)) {
      const Vec3 n = trial / size;
      after = limit / k * n;
      derivative = limit / (k * size) * (Mat3::Identity() - n * n.transpose());
    }
    const Vec3 mean = (1.0 - theta) * before + theta * after;
    response.force += k * mean;
    response.derivative += theta * k * derivative;
    response.slid += k * mean.dot(trial - after);
    slips[i] += trial - after;
  }
  return response;
}

double energy_of(std::span<const Slider> sliders, const Vec3& displacement,
                 std::span<const Vec3> slips) {
  double energy = 0.0;
  for (std::size_t i = 0; i < sliders.size(); ++i) {
    energy += 0.5 * sliders[i].stiffness * (displacement - slips[i]).squaredNorm();
  }
  return energy;
}

}  // namespace culm::soil
