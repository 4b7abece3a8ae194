#include <culm/base/error.hpp>
#include <culm/model/size_budget.hpp>

#include <fmt/format.h>

namespace culm::model {

void SizeBudget::take(double elements, double bytes, const Where& where) {
  taken_ += bytes;
  if (taken_ <= allowed_) return;
  throw InputError(where,
                   fmt::format("asks for {:.0f} elements, with which the model needs about {} "
                               "of memory and {} are allowed: take fewer elements, or allow "
                               "more with --max-memory",
                               elements, memory_text(taken_), memory_text(allowed_)));
}

std::string memory_text(double bytes) {
  if (bytes < 1e9) return fmt::format("{:.3g} MB", bytes / 1e6);
  if (bytes < 1e12) return fmt::format("{:.3g} GB", bytes / 1e9);
  return fmt::format("{:.3g} TB", bytes / 1e12);
}

}  // namespace culm::model
