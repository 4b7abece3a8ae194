/// Partners of known behaviour at each point, to see what a coupling does.
#pragma once

#include <culm/coupling/partner.hpp>

#include <Eigen/Core>

#include <memory>
#include <string>
#include <vector>

namespace culm::coupling {

/// Something that hangs on the points of a port, without moments; three coordinates per point. Its
/// steps keep its books exactly.
class PointModel {
 public:
  virtual ~PointModel() = default;
  /// Why it cannot hang on these points; empty if it can. @param reference  positions [m]
  virtual std::string objection(const Eigen::VectorXd& reference) const {
    (void)reference;
    return {};
  }
  /// Before the first step. @param reference  positions [m]  @param velocity  at the start [m/s]
  virtual void begin(const Eigen::VectorXd& reference, const Eigen::VectorXd& velocity) = 0;
  /// Mean forces of a step. @param moved  in the step [m]  @param h  its length [s]
  virtual Eigen::VectorXd forces(const Eigen::VectorXd& moved, double h) const = 0;
  /// The step is over with this motion.
  virtual void accept(const Eigen::VectorXd& moved, double h) = 0;
  virtual Books books() const = 0;
  /// All that it remembers.
  virtual Eigen::VectorXd memory() const = 0;
  virtual void restore(const Eigen::VectorXd& memory) = 0;
};

/// A mass m at each point, f = -m Dv / h with v_next = 2 Dx / h - v, as culm's own scheme has it.
std::unique_ptr<PointModel> make_added_mass(double mass);
/// A dashpot c from each point to the ground, f = -c Dx / h.
std::unique_ptr<PointModel> make_dashpot(double damping);
/// A mass m that hangs on each point by a spring k of length zero in each direction, by the
/// mid-point rule.
std::unique_ptr<PointModel> make_oscillator(double mass, double stiffness);

/// How a partner gets from its own steps to the load of a window.
enum class WindowLoad {
  mean,  ///< of all its steps: impulse over length, which with straight motion keeps all energy
  last,  ///< that of its last step, as many programs have it: energy gets lost or comes from
         ///< nowhere
};

/// A model of points that makes `steps` steps of its own in each window, its points moving
/// straight. @source Farhat, van der Zee, Geuzaine, CMAME 195 (2006) for loads over windows
class PointPartner final : public Partner {
 public:
  PointPartner(std::unique_ptr<PointModel> model, int steps, WindowLoad load)
      : model_(std::move(model)), steps_(steps), load_(load) {}

  std::string objection(const std::vector<double>& reference) const override;
  void begin(const Beginning& beginning) override;
  Eigen::VectorXd loads(const Window& window) override;
  void accept(const Window& window) override;
  Books books() const override { return model_->books(); }
  void save(const std::string& prefix, Snapshot& snapshot) override;
  void restore(const std::string& prefix, const Snapshot& snapshot) override;

 private:
  std::unique_ptr<PointModel> model_;
  int steps_;
  WindowLoad load_;
};

}  // namespace culm::coupling
