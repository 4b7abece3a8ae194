/// Friction between the surfaces of two bodies that both may move.
#pragma once

#include <culm/contact/friction.hpp>
#include <culm/mechanics/stencil.hpp>

#include <array>

namespace culm::contact {

/// Four slots x, d1, d2, d3 that carry a surface, in a step.
struct SurfaceCarrier {
  Vec3 way = Vec3::Zero();        ///< of x [m]
  Mat3 directors = Mat3::Zero();  ///< at theta, as columns
  Mat3 moved = Mat3::Zero();      ///< by which they change in the step
  Vec3 arm = Vec3::Zero();        ///< from x to where both surfaces meet, at theta [m]
};

/// Where two surfaces meet and what presses them. Derivatives are by the eight slots at the end of
/// the step, those of the first carrier before those of the second.
struct Pressed {
  SurfaceCarrier first, second;
  Vec3 normal = Vec3::UnitZ();  ///< unit vector across both surfaces, at theta
  double force = 0.0;           ///< that presses them [N]
  double stiffness = 0.0;       ///< in statics, of surfaces that stick [N/m]
  Vec3 grip = Vec3::Zero();     ///< in statics, friction of before in the first directors [N]
  std::array<Mat3, 8> place_by_slot{}, normal_by_slot{};
  std::array<Vec3, 8> force_by_slot{};
};

/// Friction of the material points that meet at a place: of each side x + sum_k xi_k d_k with
/// xi = D^-1 arm in the middle of the step. Force and counterforce act at one place, so that both
/// momenta are kept, and against the motion of these points.
struct Sliding {
  Vec3 force = Vec3::Zero();                  ///< on the second side [N]
  Vec3 way = Vec3::Zero();                    ///< of its point past that of the first [m]
  Vec<8> factors = Vec<8>::Zero();            ///< the force on slot s is factors[s] force
  Mat<24, 24> tangent = Mat<24, 24>::Zero();  ///< derivative of minus that by the slots at the end
};

Sliding slide(const Pressed& pressed, const Friction& friction, const Stencil& stencil,
              bool tangent);

}  // namespace culm::contact
