/// Soil around a line of points.
#pragma once

#include <culm/model/memoryless_batch.hpp>
#include <culm/model/structure.hpp>
#include <culm/soil/curve.hpp>

#include <utility>
#include <vector>

namespace culm::soil {

/// A point of a pile and what holds it, both times the length that it stands for.
struct Station {
  model::Marker point;
  Vec3 along = Vec3::UnitZ();  ///< direction of the pile in the reference, downward, of length one
  double length = 0.0;         ///< [m]; 1 of a tip
  SharedCurve lateral = {};    ///< by the distance that the point moves across; none if null
  SharedCurve axial = {};      ///< by how far it moves along; none if null
};

/// Soil as springs that remember nothing: with the displacement u of a station, in space,
///   W = length (P(|u - n n . u|) + T(n . u))
/// of which the force of the conserving step is the discrete derivative, so that the work is the
/// change of the potential exactly. @source formulation 3.6
class SoilLoad final : public model::MemorylessBatch {
 public:
  static constexpr int max_nodes = 4;

  SoilLoad(model::Effect effect, const model::NodeTable& nodes)
      : MemorylessBatch(std::move(effect)), nodes_(nodes) {}

  void add(Station station);
  const std::vector<Station>& stations() const { return stations_; }

  int size() const override { return static_cast<int>(stations_.size()); }
  std::vector<int> blocks(int item, const model::UnknownTable& unknowns) const override;
  bool has_tangent() const override { return true; }
  Verdict assemble(const model::State& state, const Stencil& stencil, Want want,
                   model::Target& target) override;
  double stored_energy(const model::Coordinates& q) const override;
  model::StepWork step_work(const model::State& state, const Stencil& stencil) const override;

  /// Displacement of a station [m], and the force by which the soil holds it there [N].
  struct Sample {
    Vec3 displacement = Vec3::Zero();
    Vec3 force = Vec3::Zero();
  };
  /// At rest in a configuration that is known on this rank.
  Sample sample(int item, const model::Coordinates& q) const;

 private:
  struct Answer {
    Vec3 force = Vec3::Zero();       ///< on the station
    Mat3 derivative = Mat3::Zero();  ///< of minus the force, by the place at the end of the step
  };
  Vec3 displacement(std::size_t station, const model::Coordinates& q) const;
  Answer respond(std::size_t station, const Vec3& prev, const Vec3& next, double theta) const;
  Answer respond(std::size_t station, const model::State& state, double theta) const;
  template <class Space>
  Verdict assemble_item(std::size_t i, const model::State& state, const Stencil& stencil,
                        bool tangent, model::Target& target) const;

  const model::NodeTable& nodes_;
  std::vector<Station> stations_;
  std::vector<Vec3> reference_;
};

}  // namespace culm::soil
