#pragma once

#include <culm/output/growing_file.hpp>
#include <culm/output/picture_mesh.hpp>
#include <culm/output/skin.hpp>

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace culm::output {

/// Pictures for ParaView and VTK. In the given folder
///
///     <stem>.pvd         all steps: centre lines, nodes and mid-surfaces
///     <stem>_skin.pvd    all steps: surface of structures with outlines; only if there are any
///     <stem>.<analysis>.pvd, <stem>_skin.<analysis>.pvd   the same of each analysis that has
///     steps,
///                        if there are several in the deck: their times may overlap
///     <stem>_vtu/        per step and structure type one file of each kind
///
/// Point data: displacement, director1..3, node arrays. Cell data: structure (its number; the names
/// are in the field data), every resultant, and vectors as in StructureMesh::resultant_names.
/// Points are in the deformed place already.
class Pictures {
 public:
  /// Throws FileError; InternalError if a mesh contradicts itself.
  /// @param analyses  names of those of the deck; none where collections of each are not wanted
  Pictures(const std::filesystem::path& folder, const std::string& stem,
           std::vector<StructureMesh> meshes, const std::vector<std::string>& analyses = {});

  /// Writes the files of one step. The collections may lag behind, see GrowingFile. Throws
  /// FileError.
  void add(const Picture& picture);

  /// Lists a step of an earlier run whose files are there; those that are not are left out. Throws
  /// FileError.
  /// @param analysis  its number in the deck
  void add_earlier(int index, double time, int analysis = 0);

  /// Brings the collections up to date, as at the end of a run. Throws FileError, also if somebody
  /// removed or replaced a file that was written.
  void write();

 private:
  // All structures of one type.
  struct Group {
    std::string file_part;
    std::vector<std::size_t> structures;
    std::vector<std::size_t> skinned;  // those of them that have a skin
  };

  /// The files that list pictures, of the centres or of the skins.
  struct Collections {
    std::string stem;
    std::unique_ptr<GrowingFile> whole;
    std::map<int, GrowingFile> parts;  ///< by the number of the analysis
  };

  std::string stem(const Group& group, int index) const;
  Collections begin(const std::string& stem) const;
  void list(Collections& collections, int analysis, const std::string& entry);
  void write_picture(const std::string& file, const std::string& text);
  void make_groups();
  void make_skins();

  std::filesystem::path folder_;
  std::string vtu_folder_;
  std::vector<StructureMesh> meshes_;
  std::vector<std::string> names_;
  std::vector<Skin> skins_;
  std::vector<std::vector<Vec3>> reference_skins_;
  std::vector<Group> groups_;
  std::vector<std::pair<std::string, FileIdentity>> written_;  ///< pictures, in the folder
  std::vector<std::string> analyses_;                          ///< parts of file names
  Collections centres_;
  std::optional<Collections> skins_listed_;
};

}  // namespace culm::output
