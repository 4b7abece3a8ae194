#pragma once

#include <culm/output/growing_file.hpp>
#include <culm/output/picture_mesh.hpp>
#include <culm/output/skin.hpp>
#include <culm/output/thinning.hpp>

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace culm::output {

struct VtuGrid;

/// Pictures for ParaView and VTK. In the given folder
///
///     <stem>.pvd         steps: centre lines, nodes and mid-surfaces
///     <stem>_skin.pvd    steps: surface of structures with outlines; only if there are any
///     <stem>.<analysis>.pvd, <stem>_skin.<analysis>.pvd   the same of each analysis that has
///     steps,
///                        if there are several in the deck: their times may overlap
///     <stem>_vtu/        per step and structure type one file of each kind
///
/// Of many steps every second, fourth, … of an analysis is shown, and its last one: files are many
/// times slower to write than numbers.
///
/// Point data: displacement, director1..3, node arrays. Cell data: structure (its number; the names
/// are in the field data), every resultant, and vectors as in StructureMesh::resultant_names.
/// Points are in the deformed place already.
class Pictures {
 public:
  /// Throws FileError; InternalError if a mesh contradicts itself.
  /// @param analyses  names of those of the deck; none where collections of each are not wanted
  /// @param most      of the steps of an analysis, beside its last one, at least 2; 0 for all
  Pictures(const std::filesystem::path& folder, const std::string& stem,
           std::vector<StructureMesh> meshes, const std::vector<std::string>& analyses = {},
           std::size_t most = 0);

  /// Shows a step, if it is one of those that are shown; if not, it waits to be replaced by the
  /// next one, or to be shown after all as the last of its analysis: then draw() it first. The
  /// collections may lag behind, see GrowingFile. Throws FileError.
  void add(const Picture& picture);
  /// Whether add() shows the next step of an analysis, and reads its structures.
  bool shows_next(int analysis) const;
  /// Whether the last step waits without files, and will be shown: always if there will be no other
  /// one, or if the next one is of another analysis.
  bool lacks_last() const { return waiting_ && !waiting_->is_drawn; }
  bool lacks_last_before(int analysis) const {
    return lacks_last() && waiting_->analysis != analysis;
  }
  /// Writes the files of this last step, so that who goes on from here, with add_earlier, finds
  /// them. Throws FileError.
  void draw(const Picture& last);

  /// The same for a step of an earlier run, whose files are there; those that are not are left out.
  /// Throws FileError.
  /// @param analysis  its number in the deck
  void add_earlier(int index, double time, int analysis = 0);

  /// Shows the last step, which lacks no files, and brings the collections up to date, as at the
  /// end of a run. Throws FileError, also if somebody removed or replaced a file that was written.
  void write();

  /// How many steps are shown, of all that were added.
  std::size_t shown() const;
  std::size_t added() const;

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

  /// Files of a step, each with the number of its group.
  using Files = std::vector<std::pair<std::size_t, std::string>>;
  struct Step {
    std::size_t number = 0;  ///< in its analysis
    double time = 0.0;
    Files centres;
    Files skins;
  };
  /// An analysis: its steps that are shown.
  struct Sequence {
    Thinning thinning;
    std::vector<Step> shown;
  };
  /// The last step, as long as it is none of those that are shown.
  struct Waiting {
    int analysis = 0;
    Step step;
    bool is_drawn = false;  ///< whether the files are there
  };

  std::string stem(const Group& group, int index) const;
  Collections begin(const std::string& stem) const;
  void add(int analysis, Step step, const Picture* picture);
  void show(int analysis, Step step);
  void settle();
  void remove_files(const Step& step);
  void thin_out(Sequence& sequence);
  void list(Collections& collections, int analysis, const Step& step, const Files& files);
  void list_anew(Collections& collections, Files Step::*files);
  void write_files(const Picture& picture, Step& step);
  void write_picture(const std::string& file, const VtuGrid& grid, double time);
  void make_groups();
  void make_skins();

  std::filesystem::path folder_;
  std::string vtu_folder_;
  std::vector<StructureMesh> meshes_;
  std::vector<std::string> names_;
  std::vector<Skin> skins_;
  std::vector<std::vector<Vec3>> reference_skins_;
  std::vector<Group> groups_;
  std::map<std::string, FileIdentity> written_;  ///< pictures, in the folder
  std::vector<std::string> analyses_;            ///< parts of file names
  std::size_t most_;
  std::map<int, Sequence> sequences_;  ///< by the number of the analysis
  std::optional<Waiting> waiting_;
  Collections centres_;
  std::optional<Collections> skins_listed_;
};

}  // namespace culm::output
