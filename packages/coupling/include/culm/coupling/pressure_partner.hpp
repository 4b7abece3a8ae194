/// Gas at constant pressure behind a surface between the points of a port.
#pragma once

#include <culm/coupling/partner.hpp>
#include <culm/port/faces.hpp>

#include <vector>

namespace culm::coupling {

/// Pushes on the faces with a constant pressure, wherever they are. Inside of closed faces its
/// energy is the pressure times the volume that it has lost; otherwise it keeps no books.
class PressurePartner final : public Partner {
 public:
  /// @param pressure  on the outside of the faces [Pa]
  PressurePartner(double pressure, std::vector<port::Face> faces)
      : pressure_(pressure), faces_(std::move(faces)) {}

  std::string objection(const std::vector<double>& reference) const override {
    return port::objection_to(faces_, static_cast<int>(reference.size() / 3));
  }
  void begin(const Beginning&) override {}
  Quantities wanted() const override {
    return bit(port::Quantity::position) | bit(port::Quantity::motion);
  }
  Eigen::VectorXd loads(const Window& window) override;
  void accept(const Window& window) override;
  Books books() const override;
  void save(const std::string& prefix, Snapshot& snapshot) override;
  void restore(const std::string& prefix, const Snapshot& snapshot) override;

 private:
  double pressure_;
  std::vector<port::Face> faces_;
  double volume_ = 0.0;
  double start_ = 0.0;  // volume of the first window
  bool has_started_ = false;
};

}  // namespace culm::coupling
