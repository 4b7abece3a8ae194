#pragma once

#include <culm/output/growing_file.hpp>
#include <culm/output/picture_mesh.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace culm::output {

/// What the XDMF index must know of a structure: names and sizes.
struct XdmfStructure {
  std::string name;
  std::size_t nodes = 0;
  std::size_t cells = 0;
  std::size_t topology_size = 0;
  std::vector<int> directors;  ///< numbers of those written
  std::vector<std::string> resultant_names;
  std::vector<NodeArray> node_arrays;
  std::vector<CellArray> cell_arrays;
};

/// Index in XDMF 3 through which ParaView shows the steps of a result file: a temporal collection
/// with one group of datasets per step. The numbers stay in the HDF5 file.
class XdmfFile {
 public:
  /// @param path  of the index; the result file stands beside it
  /// @param h5    file name of the result file, without folder
  /// Throws FileError.
  XdmfFile(const std::filesystem::path& path, std::string h5,
           std::vector<XdmfStructure> structures);
  XdmfFile(const std::filesystem::path& path, std::string h5,
           const std::vector<StructureMesh>& meshes);

  /// Adds a step that the result file holds already. The index may lag behind, see GrowingFile.
  /// Throws FileError.
  void add_step(int index, double time);

  /// Brings the file up to date, as at the end of a run. Throws FileError.
  void write() { file_.write(); }

 private:
  std::string h5_;
  std::vector<XdmfStructure> structures_;
  GrowingFile file_;
};

/// Writes the index beside a result file, with extension .xdmf, from what the file holds: for runs
/// that were killed. Returns the path of the index. Throws FileError.
std::filesystem::path write_xdmf_for(const std::filesystem::path& h5);

}  // namespace culm::output
