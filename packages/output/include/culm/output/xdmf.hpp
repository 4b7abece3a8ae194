#pragma once

#include <culm/output/growing_file.hpp>
#include <culm/output/picture_mesh.hpp>
#include <culm/output/structure_fields.hpp>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace culm::output {

class StateTables;

/// Index in XDMF 3 through which ParaView shows the steps of a result file: a temporal collection
/// with a grid for each
/// type of structure (those with other fields by themselves). The numbers stay in the HDF5 file.
class XdmfFile {
 public:
  /// @param path  of the index; the result file stands beside it
  /// @param h5    file name of the result file, without folder
  /// Throws FileError.
  XdmfFile(const std::filesystem::path& path, std::string h5,
           const std::vector<StructureFields>& structures);
  XdmfFile(const std::filesystem::path& path, std::string h5,
           const std::vector<StructureMesh>& meshes);
  XdmfFile(XdmfFile&&) noexcept;
  XdmfFile& operator=(XdmfFile&&) noexcept;
  ~XdmfFile();

  /// Adds a step that the result file holds already. The index may lag behind, see GrowingFile.
  /// Throws FileError.
  void add_step(int index, double time);

  /// Brings the file up to date, as at the end of a run. Throws FileError.
  void write() { file_.write(); }

 private:
  std::string h5_;
  std::unique_ptr<const StateTables> tables_;
  GrowingFile file_;
};

/// Writes the index beside a result file, with extension .xdmf, from what the file holds: for runs
/// that were killed. Returns the path of the index. Throws FileError.
std::filesystem::path write_xdmf_for(const std::filesystem::path& h5);

}  // namespace culm::output
