/// Values that vary along a member.
#pragma once

#include <culm/base/options.hpp>

#include <string>
#include <vector>

namespace culm::water {

/// One value, or one at each of the parameter "Positions", linear in between. Where two positions
/// are equal the value jumps.
class Distribution {
 public:
  /// @param one      parameter with the value that holds everywhere
  /// @param several  parameter with the values at the positions
  Distribution(const Options& options, const std::string& one, const std::string& several);
  /// Of a piece between two places, the value at one of its ends; jumps are seen from the middle.
  double at(double place, double middle) const;

 private:
  std::vector<double> values_, positions_;
};

}  // namespace culm::water
