#include <culm/coupling/pressure_partner.hpp>

#include <limits>

namespace culm::coupling {
namespace {

using port::Quantity;

// Positions at the start of a window.
std::vector<double> start_of(const Window& window) {
  std::vector<double> x = window.of(Quantity::position);
  const std::vector<double>& moved = window.of(Quantity::motion);
  for (std::size_t i = 0; i < x.size(); ++i) x[i] -= moved[6 * (i / 3) + i % 3];
  return x;
}

}  // namespace

Eigen::VectorXd PressurePartner::loads(const Window& window) {
  const std::vector<double> forces =
      port::face_forces(faces_, start_of(window), window.of(Quantity::position),
                        std::vector(faces_.size(), pressure_), {});
  Eigen::VectorXd loads = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(2 * forces.size()));
  for (std::size_t i = 0; i < forces.size(); ++i) {
    loads[static_cast<Eigen::Index>(6 * (i / 3) + i % 3)] = forces[i];
  }
  return loads;
}

void PressurePartner::accept(const Window& window) {
  if (!has_started_) start_ = port::volume(faces_, start_of(window));
  has_started_ = true;
  volume_ = port::volume(faces_, window.of(Quantity::position));
}

Books PressurePartner::books() const {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  if (!port::is_closed(faces_)) return {unknown, unknown};
  return {pressure_ * (volume_ - start_), 0.0};
}

void PressurePartner::save(const std::string& prefix, Snapshot& snapshot) {
  snapshot.set(prefix + "volumes", {volume_, start_, has_started_ ? 1.0 : 0.0});
}

void PressurePartner::restore(const std::string& prefix, const Snapshot& snapshot) {
  const std::span<const double> volumes = snapshot.numbers(prefix + "volumes", 3);
  volume_ = volumes[0];
  start_ = volumes[1];
  has_started_ = volumes[2] != 0.0;
}

}  // namespace culm::coupling
