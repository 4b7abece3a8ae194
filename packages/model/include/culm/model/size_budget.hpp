/// What a model may need of memory.
#pragma once

#include <culm/base/issue.hpp>

#include <limits>
#include <string>

namespace culm::model {

/// Who shares the work, and the memory of the machine with the most of them.
struct Processes {
  int all = 1;
  int here = 1;  ///< on the machine
};

/// Memory of a machine by what takes it [B].
struct MemoryNeed {
  double elements = 0.0;  ///< with nodes and their share of results and matrix
  double factors = 0.0;   ///< of the linear solver, or what it has instead of them
  double layers = 0.0;    ///< of shells, where results show them
  double modes = 0.0;     ///< matrix, vectors and shapes of eigenproblems

  double total() const { return elements + factors + layers + modes; }
  MemoryNeed& operator+=(const MemoryNeed& other);
  /// "592 MB (elements 262 MB, factors 330 MB)", without parts that take nothing.
  std::string text() const;
};

/// What a deck wants of its model, as far as it costs memory.
struct SizeDemands {
  int modes = 0;         ///< the most that an eigenproblem looks for; 0 without any
  int layer_arrays = 0;  ///< stresses and strains of layers: 0 to 2
  double shown_layers = std::numeric_limits<double>::infinity();  ///< at most so many of each wall
  /// Whether a solver may iterate where factors are too large, so that they need not fit.
  bool may_iterate = false;
  bool has_multipliers = false;  ///< whether constraints are equations, Form::multipliers
  Processes processes = {};
};

/// Whoever adds nodes and elements asks first, so that a number with some digits too many is a
/// mistake of the deck and not the end of the memory.
class SizeBudget {
 public:
  /// @param bytes  the most that all together may need on a machine
  explicit SizeBudget(double bytes, SizeDemands demands = {})
      : allowed_(bytes), demands_(demands) {}

  /// Take the share of elements to be. Throw InputError at `where` if that is too much.
  void take_beam(double elements, double nodes, const Where& where);
  /// @param layers  of the wall
  /// @param narrow  elements across the narrow side of a surface, on which the factors depend; 1
  ///                where nobody knows before the mesh is made
  void take_shell(double elements, double layers, double narrow, const Where& where);

  const MemoryNeed& taken() const { return taken_; }

 private:
  double on_machine(double whole, double parts) const;
  void take(double elements, const MemoryNeed& need, const Where& where);

  double allowed_;
  SizeDemands demands_;
  MemoryNeed taken_;
};

/// Throws InputError at `where` if a need is above what is allowed [B].
/// @param what  what asks for it: "asks for 10 elements, with which the model"
void refuse_above(double allowed, const MemoryNeed& need, const std::string& what,
                  const Where& where);

}  // namespace culm::model
