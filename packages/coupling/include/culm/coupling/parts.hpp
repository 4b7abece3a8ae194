/// Unknowns of different units in one scheme.
#pragma once

#include <culm/base/snapshot.hpp>
#include <culm/coupling/scheme.hpp>

#include <Eigen/Core>

#include <vector>

namespace culm::coupling {

/// Gives a scheme several vectors as one, such as loads and motions. They have other units and
/// sizes, so each part is measured by the mean size of its changes, as they were tried and as they
/// came back: then a change of loads counts as much as the change of motion that it makes, and
/// neither units nor relaxation matter.
/// @source Mehl et al., Comput. Math. Appl. 71 (2016) 869-891, for one vector of all unknowns,
/// there with weights from residuals
class PartScale {
 public:
  /// What to try after some parts and the answer to them. @pre as many, of the same sizes, always
  std::vector<Eigen::VectorXd> next(Scheme& scheme, const std::vector<Eigen::VectorXd>& tried,
                                    const std::vector<Eigen::VectorXd>& answer);
  /// The next call is about another window.
  void end_window();
  /// Between windows; under names that begin with "coupling/scale".
  void save(Snapshot& snapshot) const;
  void restore(const Snapshot& snapshot);

 private:
  void learn(const std::vector<Eigen::VectorXd>& tried, const std::vector<Eigen::VectorXd>& answer);

  std::vector<double> squares_;                  ///< sums of products of both changes of each part
  std::vector<double> scales_;                   ///< by which each part is multiplied
  std::vector<Eigen::VectorXd> tried_, answer_;  ///< of the last attempt in this window
};

}  // namespace culm::coupling
