/// Viscoelasticity: a spring and branches of Maxwell beside it.
#pragma once

#include <culm/base/options.hpp>
#include <culm/base/schema.hpp>

#include <vector>

namespace culm {

/// A spring and a dashpot in line. The strain d of its spring follows d' = e' - d / time, its
/// stress is sqrt(g_I) C_IJ sqrt(g_J) d_J on top of C e: g_I C_II on the diagonal, and for any C it
/// takes energy.
struct MaxwellBranch {
  double time = 0.0;           ///< relaxation time [s]
  std::vector<double> ratios;  ///< g, stiffness over that of the lasting spring, by strain [-]
  bool operator==(const MaxwellBranch&) const = default;
};

/// A step of a branch in which the strain grows evenly, exactly:
///   d_next = kept d_prev + gained De        mean of d = mean_kept d_prev + mean_gained De.
/// The mean does the work C d_mean . De = W_next - W_prev + D with D = 1/time times the integral
/// of d . C d, which is not negative for any step. Relaxation at a strain that is held has no
/// error; any other motion has that of taking it as straight, of second order.
/// @source Taylor, Pister, Goudreau, Int. J. Numer. Meth. Eng. 2 (1970) 45-59, eq. (19); the mean
/// and its work follow from the same integrals
struct MaxwellStep {
  double kept = 0.0;
  double gained = 0.0;
  double mean_kept = 0.0;
  double mean_gained = 0.0;

  /// @param step length of the step [s] @param time of the branch [s]
  static MaxwellStep of(double step, double time);
};

/// List "Relaxation": branches by name, each with a time and ratios of `strains` strains or one of
/// all.
Schema relaxation_schema(int strains);
/// The branches of such a list, each with `strains` ratios.
std::vector<MaxwellBranch> read_relaxation(const Options& list, int strains);

}  // namespace culm
