/// A port of a deck and the partner behind it.
#pragma once

#include <culm/base/options.hpp>
#include <culm/coupling/loose_watch.hpp>
#include <culm/coupling/point_values.hpp>
#include <culm/coupling/register_coupling.hpp>
#include <culm/parallel/comm.hpp>
#include <culm/port/port.hpp>

#include <Eigen/Core>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace culm::simulation {

using coupling::as_vector;
using coupling::translations;

/// Where a coupling of a deck writes, and what it hears again.
struct CoupledFiles {
  std::filesystem::path folder;
  std::filesystem::path replay =
      {};  ///< a record, or a folder with those of all partners, whose loads act instead
};

using Ports = std::vector<std::unique_ptr<port::Port>>;

/// How fast the points of a port have moved in the last two windows, to guess what comes.
class Pace {
 public:
  /// @param velocity  of the points and angular velocity, 6 numbers each [m/s, rad/s]
  void start(const std::vector<double>& velocity);
  /// A window that was accepted.
  void add(const coupling::Window& window);
  /// Mean velocity in the next window, if it changes as it did last.
  Eigen::VectorXd guess(double length) const;
  void save(const std::string& prefix, Snapshot& snapshot) const;
  void restore(const std::string& prefix, const Snapshot& snapshot);

 private:
  Eigen::VectorXd last_, before_;  // mean velocities; the second one is empty while there is none
  double last_length_ = 0.0;       // of their windows [s]; zero: it is that at one time
  double length_before_ = 0.0;
};

/// What went over an interface, window by window, as both sides see it.
struct InterfaceBooks {
  double work = 0.0;       ///< that the structure got [J]
  double exchanged = 0.0;  ///< sum of the sizes of the works of all windows [J]
  double largest = 0.0;    ///< of these sizes [J]
  coupling::Books partner;
  double worst_gap = 0.0;  ///< of a window, by size [J]
  double worst_start = 0.0;
  double worst_end = 0.0;  ///< of that window [s]

  /// A window that was accepted. @param done  work on the structure in it [J]
  /// @param now  what the partner says after it
  void add(const coupling::Window& window, double done, const coupling::Books& now);
  /// Energy that came from nowhere, below zero what was lost [J]; no number where the partner keeps
  /// no books.
  double gap() const { return work + partner.energy + partner.dissipated; }
  void save(const std::string& name, Snapshot& snapshot) const;
  void restore(const std::string& name, const Snapshot& snapshot);
};

/// A port, the partner that answers its motion, and what has gone between them. The loads of all
/// sides are one vector: forces [N], and moments over the size of their port.
struct CoupledSide {
  std::string name;
  std::string port_name;
  std::unique_ptr<coupling::Partner> partner;  ///< on the root
  port::Port* port = nullptr;                  ///< of the present model
  Eigen::Index first = 0;                      ///< of its loads among all
  double size = 1.0;                           ///< of the port, by which moments become forces [m]
  coupling::Quantities wanted = 0;
  InterfaceBooks books;
  double stiffness = 0.0;  ///< the largest change of answers by motion that was seen [N/m]
  Eigen::VectorXd acted, moved, answer;  ///< in the last attempt in this window
  Eigen::VectorXd velocity;  ///< at the start of the window, of schemes that are watched
  Pace pace;
  coupling::LooseWatch loose;
  std::string danger;       ///< what its loose coupling was warned of
  bool began_anew = false;  ///< when the run was resumed: it had kept nothing

  Eigen::Index count() const { return 6 * static_cast<Eigen::Index>(port->size()); }
  /// Its loads in the units of each.
  Eigen::VectorXd loads(const Eigen::VectorXd& all) const;
  /// Puts loads in the units of each among all.
  void put(Eigen::VectorXd own, Eigen::VectorXd& all) const;
  /// Throws PartnerError with what is wrong with an answer to a window; nothing if it is empty.
  void expect(const std::string& objection, const coupling::Window& about) const;
  /// Sets its loads at the port.
  void set(const Eigen::VectorXd& all) const;
};

/// Sets loads at a port, three forces and three moments per point [N, N m].
void set_loads(port::Port& port, const Eigen::VectorXd& loads);
/// Root mean square distance of points from their centre; of one point one metre.
double size_of(const std::vector<double>& points);

/// The sides of the list "Coupling" of a deck; collective, with partners on the root. Throws
/// InputError for ports that are not there, and for partners that cannot serve theirs.
std::vector<CoupledSide> make_sides(const Options& settings, const coupling::PartnerRegistry& known,
                                    const CoupledFiles& files, const Ports& ports,
                                    const parallel::Comm& comm);

}  // namespace culm::simulation
