/// Friction between the surfaces of two round beams.
#pragma once

#include <culm/contact/friction.hpp>
#include <culm/mechanics/stencil.hpp>

namespace culm::contact {

/// A point of an axis in a step, with the directors that turn its surface.
struct SurfaceCarrier {
  Vec3 way = Vec3::Zero();        ///< of the point [m]
  Mat3 directors = Mat3::Zero();  ///< at theta, as columns
  Mat3 moved = Mat3::Zero();      ///< by which they change in the step
  double share = 0.0;             ///< of r, from its point to where both surfaces meet
};

/// Both points, r from the first to the second, and what presses them.
struct Pressed {
  SurfaceCarrier first, second;
  Vec3 r = Vec3::Zero();            ///< at theta [m]
  double normal = 0.0;              ///< force N [N]
  Vec3 normal_by_r = Vec3::Zero();  ///< dN by r at the end of the step [N/m]
};

/// Friction of the material points that meet at x_1 + s_1 r = x_2 - s_2 r, s_1 + s_2 = 1: of each
/// side x + sum_k xi_k d_k with xi = +-s D^-1 r in the middle of the step. Force and counterforce
/// act at one place, so that both momenta are kept, and against the velocity of these points, so
/// that energy is only taken. The eight slots are those of both points: x, d1, d2, d3 each.
struct Sliding {
  Vec3 force = Vec3::Zero();                  ///< on the second point [N]
  Vec<8> factors = Vec<8>::Zero();            ///< the force on slot s is factors[s] force
  Mat<24, 24> tangent = Mat<24, 24>::Zero();  ///< derivative of minus that by the slots at the end
  double taken = 0.0;                         ///< energy, >= 0 [J]
};

/// @pre stencil.step > 0
Sliding slide(const Pressed& pressed, const Friction& friction, const Stencil& stencil,
              bool tangent);

}  // namespace culm::contact
