/// A model as pictures show it.
#pragma once

#include <culm/output/state_tables.hpp>
#include <culm/simulation/result_files.hpp>

#include <vector>

namespace culm::simulation {

/// The structures in the reference configuration.
std::vector<output::StructureMesh> meshes_of(const model::Model& model,
                                             const LayerSettings& layers);

/// Makes velocities of nodes [m/s], and angular velocities of those with triads [rad/s], part of
/// what is shown of the structures.
void show_velocities(std::vector<output::StructureMesh>& meshes);

/// What a rank has of a picture: the nodes that it owns, and the cells whose elements it evaluates.
class PicturePart {
 public:
  /// @param drawn       is the geometry of the mesh, of the same structures
  /// @param velocities  whether they are part of what is shown
  PicturePart(const assembly::System& system, const model::Model& drawn,
              const LayerSettings& layers, bool velocities = false);

  /// Rows of this rank, by structure.
  const std::vector<output::StructurePart>& rows() const { return rows_; }
  /// The structures, with the places of these nodes in the reference, without triads and cells.
  const std::vector<output::StructureMesh>& meshes() const { return meshes_; }
  /// Those of the whole model.
  const output::StateTables& tables() const { return tables_; }

  /// This rank's part of the picture of a configuration; index and time stay zero.
  /// @param q  up to date for the nodes that the rank needs
  output::Picture draw(const model::Coordinates& q) const;
  /// Lets displacements of a picture start from the geometry of the model of the system, which
  /// imperfections may have bent against that of the mesh.
  void add_reference(output::Picture& picture) const;
  /// Adds velocities; zero in statics.
  void add_velocities(const model::State& state, output::Picture& picture) const;

  /// The whole picture, on rank 0. Collective.
  output::Picture gather(output::Picture picture) const;

 private:
  const assembly::System* system_;
  LayerSettings layers_;
  std::vector<output::StructurePart> rows_;
  std::vector<output::StructureMesh> meshes_;
  output::StateTables tables_;
};

/// The structures in a configuration, on rank 0; index and time stay zero. Collective.
/// @param q  up to date for the nodes that each rank needs
output::Picture picture_of(const assembly::System& system, const model::Coordinates& q);

}  // namespace culm::simulation
