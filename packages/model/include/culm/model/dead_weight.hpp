/// Loads whose work follows from their potential.
#pragma once

namespace culm::model {

/// A batch of loads that may be constant in time and space: their work is the fall of their
/// potential, and all that Batch::step_work tells of them are force and moment. Where supports take
/// these up, nobody asks for them.
class DeadWeight {
 public:
  virtual ~DeadWeight() = default;

  /// Whether they are.
  virtual bool has_potential() const = 0;
};

}  // namespace culm::model
