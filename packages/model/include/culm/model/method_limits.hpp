/// What batches say of the limits of their methods, so that nobody takes results beyond for sound.
#pragma once

#include <string>

namespace culm::model {

/// A method that is good for some states only.
class LimitedRange {
 public:
  virtual ~LimitedRange() = default;
  /// How far the items that this rank counts have gone in the last accepted step, over what the
  /// method is good for: above one outside; 0 without items.
  virtual double range_used() const = 0;
  /// What it means that so much was used: a sentence without full stop.
  virtual std::string range_warning(double used) const = 0;
};

/// Forces of which a linearisation about a state does not know all.
class LeftOutOfModes {
 public:
  virtual ~LeftOutOfModes() = default;
  /// What is left out: a sentence without full stop; empty if nothing is.
  virtual std::string left_out_of_modes() const = 0;
};

/// Forces whose tangent leaves something out, so that residuals of Newton's method fall by a
/// constant factor at last.
class PartialTangent {
 public:
  virtual ~PartialTangent() = default;
};

}  // namespace culm::model
