#include "coupled_guess.hpp"

#include <culm/math/rotation.hpp>

namespace culm::simulation {
namespace {

using coupling::bit;
using Eigen::VectorXd;

std::vector<VectorXd> parts_of(const CoupledGuess& guess, const std::vector<CoupledSide>& sides) {
  std::vector<VectorXd> parts = {guess.loads};
  for (std::size_t i = 0; i < sides.size(); ++i) {
    for (const port::Quantity q : coupling::all_quantities) {
      if ((sides[i].wanted & bit(q)) != 0) parts.push_back(as_vector(guess.motions[i].of(q)));
    }
  }
  return parts;
}

// What schemes make of rotations is none.
void make_rotations(std::vector<double>& values) {
  for (std::size_t i = 0; i + 9 <= values.size(); i += 9) {
    Eigen::Map<Mat3> R(values.data() + i);  // transposed, which changes nothing
    R = nearest_rotation(R);
  }
}

}  // namespace

CoupledGuess improve(coupling::Scheme& scheme, coupling::PartScale& scale,
                     const std::vector<CoupledSide>& sides, const CoupledGuess& guess,
                     const CoupledGuess& found) {
  const std::vector<VectorXd> parts =
      scale.next(scheme, parts_of(guess, sides), parts_of(found, sides));
  CoupledGuess next = guess;
  next.loads = parts[0];
  std::size_t part = 1;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    coupling::Window& motion = next.motions[i];
    for (const port::Quantity q : coupling::all_quantities) {
      if ((sides[i].wanted & bit(q)) == 0) continue;
      motion.of(q).assign(parts[part].begin(), parts[part].end());
      ++part;
    }
    make_rotations(motion.of(port::Quantity::rotation));
  }
  return next;
}

}  // namespace culm::simulation
