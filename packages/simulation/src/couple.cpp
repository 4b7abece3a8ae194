#include <culm/analysis/dynamics.hpp>
#include <culm/base/error.hpp>
#include <culm/simulation/couple.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

namespace culm::simulation {
namespace {

using Eigen::VectorXd;

// The first three of six numbers per point.
VectorXd translations(const std::vector<double>& values) {
  const Eigen::Map<const Eigen::Matrix<double, 6, Eigen::Dynamic>> all(
      values.data(), 6, static_cast<Eigen::Index>(values.size() / 6));
  return all.topRows<3>().reshaped();
}

// One step after the other, each as often as the scheme wants it.
class Coupling {
 public:
  Coupling(Simulation& simulation, analysis::Stepper& stepper, const std::string& port,
           coupling::Partner& partner, coupling::Scheme& scheme, const CouplingSettings& settings)
      : simulation_(simulation),
        stepper_(stepper),
        port_(port),
        partner_(partner),
        scheme_(scheme),
        settings_(settings) {
    if (dynamic_cast<const analysis::Dynamics*>(&stepper) == nullptr) {
      throw UsageError("partners move in time: the analysis must be of type 'Dynamic'");
    }
    partner.begin(translations(simulation.read_port(port, port::Quantity::velocity)));
    forces_ = VectorXd::Zero(3 * simulation.port(port).size());
  }

  CouplingReport run() {
    while (!stepper_.is_at_end()) {
      if (make_window(stepper_.proposal())) continue;
      stepper_.fail();
      if (stepper_.is_exhausted()) stepper_.give_up();
    }
    report_.energy = partner_.energy();
    report_.dissipated = partner_.dissipated();
    return report_;
  }

 private:
  // @return false if the structure did not converge
  bool make_window(double end) {
    const double h = end - stepper_.time();
    VectorXd bearable;  // the last loads that the structure converged with
    for (int tried = 1; tried <= settings_.most; ++tried) {
      ++report_.attempts;
      report_.most_attempts = std::max(report_.most_attempts, tried);
      simulation_.set_port(
          port_, std::span<const double>(forces_.data(), static_cast<std::size_t>(forces_.size())));
      if (!stepper_.attempt(end).accepted) {
        if (tried == 1) return false;
        forces_ = 0.5 * (forces_ + bearable);  // a guess that the structure cannot bear
        continue;
      }
      bearable = forces_;
      const VectorXd moved = translations(simulation_.read_port(port_, port::Quantity::motion));
      const VectorXd answer = partner_.forces(moved, h);
      const bool fits = !scheme_.is_implicit() || (answer - forces_).norm() <= allowed(answer, h);
      if (fits) accept(moved, h);
      forces_ = scheme_.is_implicit() && fits ? answer : scheme_.next(forces_, answer);
      if (!fits) continue;
      scheme_.end_window();
      return true;
    }
    throw NumericalError(fmt::format(
        "the partner at port '{}' and the structure did not agree in {} attempts of the step from "
        "{:g} s to {:g} s; quasi-Newton is the most robust scheme",
        port_, settings_.most, stepper_.time(), end));
  }

  // What is asked for, and what rounding of positions makes of forces.
  double allowed(const VectorXd& answer, double h) {
    constexpr double round_off = 16.0 * std::numeric_limits<double>::epsilon();
    const std::vector<double> x = simulation_.read_port(port_, port::Quantity::position);
    const double size =
        Eigen::Map<const VectorXd>(x.data(), static_cast<Eigen::Index>(x.size())).norm();
    return settings_.tolerance * answer.norm() + round_off * size * partner_.stiffness(h);
  }

  void accept(const VectorXd& moved, double h) {
    const double work = simulation_.exchange(port_).work;
    report_.work += work;
    report_.exchanged += std::abs(work);
    ++report_.windows;
    stepper_.accept();
    partner_.accept(moved, h);
  }

  Simulation& simulation_;
  analysis::Stepper& stepper_;
  std::string port_;
  coupling::Partner& partner_;
  coupling::Scheme& scheme_;
  CouplingSettings settings_;
  VectorXd forces_;
  CouplingReport report_;
};

}  // namespace

CouplingReport couple(Simulation& simulation, analysis::Stepper& stepper, const std::string& port,
                      coupling::Partner& partner, coupling::Scheme& scheme,
                      const CouplingSettings& settings) {
  return Coupling(simulation, stepper, port, partner, scheme, settings).run();
}

}  // namespace culm::simulation
