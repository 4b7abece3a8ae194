/// What a model may need of memory.
#pragma once

#include <culm/base/issue.hpp>

namespace culm::model {

/// Whoever adds nodes and elements asks first, so that a number with some digits too many is a
/// mistake of the deck and not the end of the memory.
class SizeBudget {
 public:
  /// Memory of an element of a shell and of a node of a beam, with their share of results and
  /// matrix but without its factors [B]; measured with `culm check`.
  static constexpr double shell_element = 16e3;
  static constexpr double beam_node = 8e3;

  /// @param bytes  the most that all together may need
  explicit SizeBudget(double bytes) : allowed_(bytes) {}

  /// Takes a share. Throws InputError at `where` if that is too much.
  /// @param elements  how many are asked for
  /// @param bytes     that they need
  void take(double elements, double bytes, const Where& where);

 private:
  double allowed_;
  double taken_ = 0.0;
};

/// "16 GB", "3.4 TB"
std::string memory_text(double bytes);

}  // namespace culm::model
