/// What a tower does to the wind around it.
#pragma once

#include <culm/flow/flow.hpp>

#include <functional>

namespace culm::flow {

/// Registers a type of wind with the optional list "Tower Influence".
/// @param make  the wind without a tower
void add_wind(FlowRegistry& registry, const std::string& name, Schema schema,
              std::function<SharedFlow(const Options&, model::BuildContext&)> make);

/// The change of a wind by a tower.
class TowerInfluence {
 public:
  /// Flow about the upstream half: as if without friction, or with the wake of Bak.
  enum class Upstream { none, potential, bak };
  /// Wake behind it.
  enum class Downstream { none, powles, eames };

  Upstream upstream = Upstream::potential;
  Downstream downstream = Downstream::powles;
  double drag = 1.0;        ///< coefficient of the tower
  double turbulence = 0.1;  ///< intensity, of the wake of Eames

  /// Change of the velocity over that of the wind, along it and across.
  /// @param along, across  of the place from the axis, over the radius; inside as at the surface
  /// @source OpenFAST, theory of AeroDyn, section on the influence of the tower
  Eigen::Vector2d change(double along, double across) const;
};

}  // namespace culm::flow
