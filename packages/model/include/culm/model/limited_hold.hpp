/// What batches that hold by friction say of it, so that causes of failures are named.
#pragma once

namespace culm::model {

/// Forces that hold what they act on up to a limit only, and then let it slide.
class LimitedHold {
 public:
  virtual ~LimitedHold() = default;
  /// Whether there are any in this model.
  virtual bool may_slide() const = 0;
};

}  // namespace culm::model
