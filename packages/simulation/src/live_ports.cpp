// Ports of simulations that another program drives.

#include <culm/base/error.hpp>
#include <culm/base/nearest.hpp>
#include <culm/simulation/simulation.hpp>

#include "on_root.hpp"
#include "port_picture.hpp"
#include "simulation_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace culm::simulation {
namespace {

port::Port& find_port(const Phase& phase, const std::string& name) {
  std::vector<std::string> names;
  for (const auto& port : phase.ports) {
    if (port->name() == name) return *port;
    names.push_back(port->name());
  }
  throw UsageError("there is no port '" + name + "'" + did_you_mean(name, names));
}

}  // namespace

void Simulation::add_port(const std::string& name, port::Cloud cloud) {
  Parts& p = *parts_;
  if (!p.state.next.empty()) throw UsageError("a port is added before the first 'begin'");
  const std::vector<std::string> taken = port_names();
  if (std::find(taken.begin(), taken.end(), name) != taken.end()) {
    throw UsageError("there is a port '" + name + "' already");
  }
  if (cloud.points.empty() || cloud.points.size() % 3 != 0) {
    throw UsageError("port '" + name + "' needs three numbers per point, got " +
                     std::to_string(cloud.points.size()));
  }
  if (!std::all_of(cloud.points.begin(), cloud.points.end(),
                   [](double x) { return std::isfinite(x); })) {
    throw NonFiniteError("port '" + name + "' got a point that is no number");
  }
  if (!(cloud.reach > 0.0)) {
    throw UsageError(fmt::format("port '{}' needs a reach above 0 m, got {}", name, cloud.reach));
  }
  p.phases.add_port(name, std::move(cloud));
  p.tell_of(port(name));
}

std::vector<std::string> Simulation::port_names() const {
  std::vector<std::string> names;
  for (const auto& port : parts_->phases.of(parts_->present).ports) names.push_back(port->name());
  return names;
}

const port::Port& Simulation::port(const std::string& name) const {
  return find_port(parts_->phases.of(parts_->present), name);
}

const model::State& Simulation::both_ends() {
  const model::State& now = state();
  parts_->context->system.complete(parts_->state.prev);
  return now;
}

std::vector<double> Simulation::read_port(const std::string& name, port::Quantity quantity) {
  return port(name).read(quantity, both_ends());
}

void Simulation::set_port(const std::string& name, std::span<const double> forces,
                          std::span<const double> moments) {
  port::Port& port = find_port(parts_->phases.of(parts_->present), name);
  port.set_loads(forces, moments);
  if (parts_->stepper != nullptr) parts_->stepper->outdate();
  if (port.is_loaded()) parts_->hear({"Port", name});
}

void Simulation::set_port_pressure(const std::string& name, std::span<const port::Face> faces,
                                   std::span<const double> pressure,
                                   std::span<const double> traction) {
  const port::Port& port = this->port(name);
  const std::string objection = port::objection_to(faces, port.size());
  if (!objection.empty()) throw UsageError("port '" + name + "': " + objection);
  const auto require_size = [&](std::span<const double> values, std::size_t each,
                                const char* what) {
    if (values.empty() || values.size() == each * faces.size()) return;
    throw UsageError(fmt::format("port '{}' takes {} values of {} for {} faces, got {}", name,
                                 each * faces.size(), what, faces.size(), values.size()));
  };
  require_size(pressure, 1, "pressure");
  require_size(traction, 3, "traction");
  const model::State& state = both_ends();
  const std::vector<double> end = port.read(port::Quantity::position, state);
  const std::vector<double> moved = port.read(port::Quantity::motion, state);
  std::vector<double> start = end;
  for (std::size_t i = 0; i < start.size(); ++i) start[i] -= moved[6 * (i / 3) + i % 3];
  set_port(name, port::face_forces(faces, start, end, pressure, traction));
}

port::Exchange Simulation::exchange(const std::string& name) {
  return port(name).exchange(both_ends());
}

void Simulation::write_port(const std::string& name, const std::filesystem::path& path) const {
  on_root(parts_->comm, [&] { draw_port(port(name), model(), path); });
}

}  // namespace culm::simulation
