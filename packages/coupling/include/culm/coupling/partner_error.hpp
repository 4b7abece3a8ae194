#pragma once

#include <culm/base/error.hpp>

namespace culm {

/// The program on the other side of a coupling left, was silent for too long, or said what makes no
/// sense. The text names it, the window and what it said.
class PartnerError final : public Error {
 public:
  using Error::Error;
  int exit_code() const noexcept override { return 9; }
};

}  // namespace culm
