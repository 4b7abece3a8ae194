/// Spectra of irregular waves.
#pragma once

namespace culm::water {

/// What is known of a sea of irregular waves.
struct SeaState {
  double height = 0.0;  ///< significant, four standard deviations of the surface [m]
  double period = 0.0;  ///< of the peak [s]
  double peak = 1.0;    ///< gamma, by which the peak rises above that of a grown sea [-]
};

/// Variance of the surface per frequency [m^2 s] of the JONSWAP spectrum; with `peak` = 1 that of
/// Pierson and Moskowitz. Its integral is height^2 / 16 but for what the usual factor
/// 1 - 0.287 ln gamma, a fit, leaves. @param frequency  [Hz]
/// @source DNV-RP-C205, section 3.5.5; IEC 61400-3, annex B
double jonswap(const SeaState& sea, double frequency);

/// The peak gamma where nothing is known of it. @source IEC 61400-3, annex B
double usual_peak(double height, double period);

}  // namespace culm::water
