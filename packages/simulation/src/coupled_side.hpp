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
  double work = 0.0;       ///< that the structure got [J]
  double exchanged = 0.0;  ///< sum of the sizes of the works of all windows [J]
  coupling::Books books;
  double stiffness = 0.0;  ///< the largest change of answers by motion that was seen [N/m]
  Eigen::VectorXd acted, moved, answer;  ///< in the last attempt in this window
  Eigen::VectorXd velocity;  ///< at the start of the window, of schemes that are watched
  coupling::LooseWatch loose;

  Eigen::Index count() const { return 6 * static_cast<Eigen::Index>(port->size()); }
  /// Its loads in the units of each.
  Eigen::VectorXd loads(const Eigen::VectorXd& all) const;
  /// Puts loads in the units of each among all.
  void put(Eigen::VectorXd own, Eigen::VectorXd& all) const;
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
