/// Partners of known behaviour, to see what a coupling does.
#pragma once

#include <Eigen/Core>

#include <memory>
#include <string>
#include <vector>

namespace culm::coupling {

/// Answers the motion of points with forces, in windows: as often as wanted from the same start,
/// then accepted once. All points alike, three coordinates each.
class Partner {
 public:
  virtual ~Partner() = default;
  /// Before the first window: velocities at its start [m/s].
  virtual void begin(const Eigen::VectorXd& velocity) = 0;
  /// Mean forces of a window. @param moved  in the window [m]  @param h  its length [s]
  virtual Eigen::VectorXd forces(const Eigen::VectorXd& moved, double h) const = 0;
  /// The window is over with this motion.
  virtual void accept(const Eigen::VectorXd& moved, double h) = 0;
  /// What it holds and what it has turned into heat since the beginning [J].
  virtual double energy() const = 0;
  virtual double dissipated() const { return 0.0; }
  /// How much its forces change with the motion in a window [N/m]: what rounding of motions makes
  /// of them.
  virtual double stiffness(double h) const = 0;
};

/// A mass m at each point, f = -m Dv / h with v_next = 2 Dx / h - v, as culm's own scheme has it.
std::unique_ptr<Partner> make_added_mass(double mass);
/// A dashpot c from each point to the ground, f = -c Dx / h.
std::unique_ptr<Partner> make_dashpot(double damping);
/// A mass m that hangs on each point by a spring k of length zero in each direction, by the
/// mid-point rule.
std::unique_ptr<Partner> make_oscillator(double mass, double stiffness);

/// Numbers of partners; those that one does not have are of no use to it.
struct PartnerNumbers {
  double mass = 1.0;       ///< [kg]
  double damping = 1.0;    ///< [N s/m]
  double stiffness = 1.0;  ///< [N/m]
};
/// By its name in the command line: added-mass, dashpot, oscillator; null if there is none.
std::unique_ptr<Partner> find_partner(const std::string& name, const PartnerNumbers& numbers);
std::vector<std::string> partner_names();

}  // namespace culm::coupling
