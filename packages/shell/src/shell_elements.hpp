/// The elements of a shell structure.
#pragma once

#include <culm/base/options.hpp>
#include <culm/material/layup.hpp>
#include <culm/model/model.hpp>
#include <culm/shell/shell_geometry.hpp>
#include <culm/shell/shell_mesh.hpp>

#include <memory>

namespace culm::shell {

/// What elements assume, as the list of a shell says.
ShellOptions read_options(const Options& options);

/// Adds those of a mesh, by 'Fidelity' and material, and to the structure, which has its nodes,
/// what shows them, what is loaded and, but for a rigid one, what happens within the wall.
void add_elements(const ShellMesh& mesh, const std::shared_ptr<const material::Layup>& layup,
                  const Options& options, model::Structure& structure, model::Model& model);

}  // namespace culm::shell
