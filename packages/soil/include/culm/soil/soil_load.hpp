/// Soil around a line of points.
#pragma once

#include <culm/model/booked.hpp>
#include <culm/model/memoryless_batch.hpp>
#include <culm/model/structure.hpp>
#include <culm/soil/curve.hpp>
#include <culm/soil/sliders.hpp>

#include <cstddef>
#include <span>
#include <string>
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
  /// Instead of a curve, where soil remembers.
  std::vector<Slider> lateral_sliders = {}, axial_sliders = {};
  /// The part of the pile's length that it stands for; a tip begins where it ends [m].
  double begin = 0.0, end = 0.0;

  bool holds_across() const { return lateral != nullptr || !lateral_sliders.empty(); }
  bool holds_along() const { return axial != nullptr || !axial_sliders.empty(); }
};

/// Soil as springs: with the displacement u of a station, in space,
///   W = length (P(|u - n n . u|) + T(n . u))
/// of which the force of the conserving step is the discrete derivative, so that the work is the
/// change of the potential exactly; or as springs that slide, with what they slid as memory.
/// @source formulation 3.6
class SoilLoad final : public model::MemorylessBatch, public model::Booked {
 public:
  static constexpr int max_nodes = 4;
  static constexpr std::size_t max_sliders = 64;  ///< of a station across, and along

  SoilLoad(model::Effect effect, const model::NodeTable& nodes)
      : MemorylessBatch(std::move(effect)), nodes_(nodes) {}

  void add(Station station);
  const std::vector<Station>& stations() const { return stations_; }
  /// Names the pile, once it is known.
  void set_pile(std::string name) { pile_ = std::move(name); }
  /// The first station of this load that holds the pile where one of another load does so in the
  /// same direction; null if there is none.
  const Station* meets(const SoilLoad& other) const;

  int size() const override { return static_cast<int>(stations_.size()); }
  std::vector<int> blocks(int item, const model::UnknownTable& unknowns) const override;
  bool has_tangent() const override { return true; }
  Verdict assemble(const model::State& state, const Stencil& stencil, Want want,
                   model::Target& target) override;
  void accept(model::State& state) override;
  bool depends_on_path() const override { return !slips_.empty(); }
  std::size_t memory_size() const override { return 3 * slips_.size(); }
  void save(model::Items items, std::span<double> numbers) const override;
  void restore(std::span<const double> numbers) override;
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
    double slid = 0.0;               ///< work of sliding [J]
  };
  /// Slips of the lateral and axial sliders of a station: where they begin, and how many.
  std::span<const Vec3> slips_of(std::size_t station) const;
  /// The sliders of a station; moves its slips on.
  Answer slide_station(std::size_t station, const Vec3& prev, const Vec3& next, double theta,
                       std::span<Vec3> slips) const;
  Vec3 displacement(std::size_t station, const model::Coordinates& q) const;
  Answer respond(std::size_t station, const Vec3& prev, const Vec3& next, double theta) const;
  Answer respond(std::size_t station, const model::State& state, double theta) const;
  template <class Space>
  Verdict assemble_item(std::size_t i, const model::State& state, const Stencil& stencil,
                        bool tangent, model::Target& target) const;

  const model::NodeTable& nodes_;
  std::string pile_;
  std::vector<Station> stations_;
  std::vector<Vec3> reference_;
  std::vector<std::size_t> first_slip_;  ///< by station
  std::vector<Vec3> slips_;              ///< of all sliders, accepted
};

}  // namespace culm::soil
