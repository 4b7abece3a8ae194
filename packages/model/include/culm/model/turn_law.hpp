/// What interpolated directors make of an element whose nodes are turned against each other.
#pragma once

namespace culm::model {

/// Errors of an element bent or twisted to a constant curvature, relative to the exact beam; of
/// second order of the turn for order 1, of fourth order for 2 and 3.
struct TurnErrors {
  double energy = 0.0;     ///< strain energy under a given load, too high by this
  double moment = 0.0;     ///< moment at a given turn, too low by this
  double stiffness = 0.0;  ///< of the next small turn, and with it buckling loads, too low by this
};

/// Directors interpolated by polynomials of an order from 1 to 3 between equidistant nodes, strains
/// taken at as many Gauss points: with h times the curvature F(Δ) for a turn Δ between the ends
/// instead of Δ, energy EI/2h (F - F0)^2, moment its derivative. F is sin Δ for order 1; inner
/// nodes stand in equilibrium. @source formulation 1.3.4
class TurnLaw {
 public:
  /// @pre order from 1 to 3
  explicit TurnLaw(int order) : order_(order) {}

  int order() const { return order_; }
  /// @param turn       between the ends, over the intervals of the nodes [rad]; what is beyond
  ///                   greatest_moment() counts as that
  /// @param reference  the same without load
  TurnErrors errors(double turn, double reference = 0.0) const;
  /// The turn with this error of the energy [rad].
  double turn_with(double energy_error) const;
  /// The turn beyond which the moment of an element that was straight falls [rad].
  double greatest_moment() const;

 private:
  int order_;
};

}  // namespace culm::model
