/// Foresees the death of couplings that exchange loads once per window.
#pragma once

#include <Eigen/Core>

#include <string>

namespace culm::coupling {

/// A partner that answers acceleration with -m_a a makes, with loads that are one window late, of a
/// load f the next one -(m_a / m_s) f, where m_s is the mass of the structure at the port: whatever
/// the window, loads grow from m_a = m_s on. @source Causin, Gerbeau, Nobile, CMAME 194 (2005)
/// 4506-4527
class LooseWatch {
 public:
  /// A window that was accepted. @param answer  of the partner to it [N]
  /// @param acceleration  mean of the points in it [m/s^2]
  void add(const Eigen::VectorXd& answer, const Eigen::VectorXd& acceleration);
  /// A change of the loads by which the mass of the structure can be measured: the present one, as
  /// often as it has grown, since what grows shows where the structure is light. Empty if it is not
  /// time for it.
  Eigen::VectorXd probe() const;
  /// What a probe did. @param load  change of the load [N]
  /// @param acceleration  change of the mean acceleration [m/s^2]
  void measure(const Eigen::VectorXd& load, const Eigen::VectorXd& acceleration);

  /// What is about to happen, each reason once; empty if nothing is known of any danger.
  std::string warning();

 private:
  int windows_ = 0;
  Eigen::VectorXd answer_, change_, acceleration_;
  double change_by_acceleration_ = 0.0;  ///< change of the answer by that of the acceleration
  double acceleration_square_ = 0.0;     ///< of that itself
  double structure_ = 0.0;               ///< mass [kg]; zero while unknown
  double probed_ = 0.0;                  ///< size of the last probe [N]
  int probes_ = 0;
  int flips_ = 0;            ///< windows in a row in which loads change their sign
  double first_flip_ = 0.0;  ///< size of the load before the first of them [N]
  bool has_foreseen_ = false;
  bool has_seen_ = false;
};

}  // namespace culm::coupling
