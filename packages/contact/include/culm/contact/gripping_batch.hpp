/// What batches share whose points remember the friction that holds them.
#pragma once

#include <culm/model/limited_hold.hpp>
#include <culm/model/memoryless_batch.hpp>

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace culm::contact {

/// A vector per item, the friction on it at the end of the last step that was accepted, from which
/// the next step of statics goes on. Without friction there is none.
class GrippingBatch : public model::MemorylessBatch, public model::LimitedHold {
 public:
  void prepare(const model::State&, const Stencil& stencil) override { stencil_ = stencil; }
  bool depends_on_path() const override { return has_grips(); }
  std::size_t memory_size() const override { return 3 * grips_.size(); }
  void save(model::Items items, std::span<double> numbers) const override;
  void restore(std::span<const double> numbers) override;
  bool may_slide() const override { return has_grips(); }

 protected:
  explicit GrippingBatch(model::Effect effect) : MemorylessBatch(std::move(effect)) {}

  void add_grip() { grips_.push_back(Vec3::Zero()); }
  bool has_grips() const { return !grips_.empty(); }
  Vec3& grip(int item) { return grips_[static_cast<std::size_t>(item)]; }
  const Vec3& grip(int item) const { return grips_[static_cast<std::size_t>(item)]; }
  /// Of the step that was tried last.
  const Stencil& stencil() const { return stencil_; }

 private:
  Stencil stencil_;
  std::vector<Vec3> grips_;
};

}  // namespace culm::contact
