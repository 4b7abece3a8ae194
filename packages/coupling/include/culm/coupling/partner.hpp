/// Who answers the motion of a port with loads.
#pragma once

#include <culm/base/snapshot.hpp>
#include <culm/coupling/window.hpp>

#include <limits>
#include <string>

namespace culm::coupling {

/// The other side of a port. In windows: asked for loads as often as wanted, each time from the
/// start of the window, then accepted once.
class Partner {
 public:
  virtual ~Partner() = default;
  /// Why it cannot serve a port with these points; empty if it can. Known from the beginning.
  /// @param reference  positions, 3 numbers per point [m]
  virtual std::string objection(const std::vector<double>& reference) const {
    (void)reference;
    return {};
  }
  /// Once, before the first window. Throws PartnerError where they do not fit together.
  virtual void begin(const Beginning& beginning) = 0;
  /// What it must know of each window; known after begin.
  virtual Quantities wanted() const { return bit(port::Quantity::motion); }
  /// Where a window must end at the latest that begins here [s]; known after begin.
  virtual double latest_end(double start) const {
    (void)start;
    return std::numeric_limits<double>::infinity();
  }
  /// Begins to work on its answer, if it can do so while culm does something else: the next call of
  /// loads is about this window.
  virtual void pose(const Window& window) { (void)window; }
  /// Mean loads of the window: three forces and three moments for each point [N, N m]. What the
  /// partner knows is afterwards what it knew before.
  virtual Eigen::VectorXd loads(const Window& window) = 0;
  /// The window is over, with this motion.
  virtual void accept(const Window& window) = 0;
  /// Of all windows that were accepted.
  virtual Books books() const = 0;
  /// What it needs to go on, under names that begin with `prefix`; between windows.
  virtual void save(const std::string& prefix, Snapshot& snapshot) = 0;
  /// After begin.
  virtual void restore(const std::string& prefix, const Snapshot& snapshot) = 0;
  /// The run is over. @param why  it failed; empty if it did not
  virtual void end(const std::string& why) { (void)why; }
  /// What does not hold that it has promised, in a sentence; empty if all does.
  virtual std::string complaint() const { return {}; }
  /// What it holds that no window has come to, in a sentence; for when the run is over.
  virtual std::string left_over() const { return {}; }
};

}  // namespace culm::coupling
