/// The types of ports in a deck.
#pragma once

#include <culm/base/registry.hpp>
#include <culm/model/build_context.hpp>
#include <culm/port/port.hpp>
#include <culm/port/projection.hpp>

#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace culm::port {

/// Types of the deck's list "Ports": where the points of one are. Nothing, after an issue, where
/// the deck asks for what is not there.
using PortRegistry = Registry<std::vector<Place>, model::BuildContext&>;

void register_ports(PortRegistry& registry);

/// A cloud of a partner's points to attach, and how.
struct Cloud {
  std::vector<double> points;           ///< 3 numbers per point, in the reference [m]
  std::vector<std::string> structures;  ///< on which they may lie; all if empty
  double reach = std::numeric_limits<double>::infinity();  ///< how far they may be from them [m]
  Weights weights = Weights::elements;
};

/// The places of a cloud. @param issue  says why a point or a structure has none; empty if all have
std::vector<Place> attach(const Cloud& cloud, const model::Model& model, std::string& issue);

/// Makes a port and adds its loads to the model.
std::unique_ptr<Port> add_port(const std::string& name, std::vector<Place> places,
                               model::Model& model);

}  // namespace culm::port
