/// Layers of soil as the deck describes them.
#pragma once

#include <culm/base/registry.hpp>
#include <culm/soil/curve.hpp>

#include <functional>

namespace culm::soil {

/// What holds a pile at one depth.
struct Grip {
  SharedCurve lateral;  ///< per length
  SharedCurve axial;    ///< per length; null if the layer has no shaft
};

/// A pile as soil sees it.
struct Pile {
  double diameter = 0.0;  ///< [m]
  bool cyclic = false;    ///< loads that have come many times
};

/// A depth below the ground.
struct Depth {
  double below = 0.0;        ///< [m]
  double unit_weight = 0.0;  ///< effective, mean of all soil above [N/m^3]
};

/// What a layer does at a depth.
using Layer = std::function<Grip(const Depth&, const Pile&)>;

/// Types of layers in the list "Layers" of a soil: Sand, Clay, Springs, Table.
using LayerRegistry = Registry<Layer>;
void register_layers(LayerRegistry& registry);

/// Displacements [m] and fractions of the whole resistance, as `Displacements` and `Fractions`.
Schema fractions_schema(Schema schema);
/// The curve of such a list, or of what it leaves out, for a resistance.
SharedCurve fractions_curve(const Options& list, const std::vector<double>& displacements,
                            const std::vector<double>& fractions, double resistance,
                            TableCurve::Sides sides);

}  // namespace culm::soil
