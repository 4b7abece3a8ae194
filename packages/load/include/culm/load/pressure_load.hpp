/// Pressure on faces of shells.
#pragma once

#include <culm/model/amplitude.hpp>
#include <culm/model/booked.hpp>
#include <culm/model/memoryless_batch.hpp>
#include <culm/model/projection.hpp>

#include <array>
#include <string>
#include <vector>

namespace culm::load {

/// A pressure a(t) p that stays normal to the surface X = sum_a N_a (x_a + zeta d_a) and acts on
/// its current area. Positive along g1 x g2, the side the directors point to:
///   f_x_a = a p int N_a g1 x g2 dxi deta      f_d_a = zeta f_x_a
/// Taken at q_theta, so a step keeps the momentum balance, and a closed surface has no resultant.
/// @source formulation 3.4
class PressureLoad final : public model::MemorylessBatch, public model::Booked {
 public:
  PressureLoad(model::Effect effect, const model::NodeTable& nodes, model::Amplitude amplitude)
      : MemorylessBatch(std::move(effect)), nodes_(nodes), amplitude_(std::move(amplitude)) {}

  /// @param nodes  counter-clockwise seen from the side the directors point to
  /// @param zeta  of the loaded surface along the directors [m]
  /// @param pressure  [Pa]
  void add_face(const std::array<int, 4>& nodes, double zeta, double pressure) {
    items_.push_back({{nodes.begin(), nodes.end()}, zeta, pressure});
  }

  int size() const override { return static_cast<int>(items_.size()); }
  std::vector<int> blocks(int item, const model::UnknownTable& unknowns) const override;
  bool has_tangent() const override { return true; }
  Verdict assemble(const model::State& state, const Stencil& stencil, Want want,
                   model::Target& target) override;
  model::StepWork step_work(const model::State& state, const Stencil& stencil) const override;

 private:
  struct Item {
    std::vector<int> nodes;
    double zeta;
    double pressure;
  };

  template <class Space>
  Verdict assemble_item(std::size_t i, const model::State& state, const Stencil& stencil,
                        double factor, bool tangent, model::Target& target) const;

  const model::NodeTable& nodes_;
  model::Amplitude amplitude_;
  std::vector<Item> items_;
};

}  // namespace culm::load
