#include <culm/output/vtu.hpp>

#include "names.hpp"
#include "picture_grids.hpp"
#include "replace_file.hpp"
#include "vtu_grid.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <set>
#include <utility>

namespace culm::output {

namespace {

GrowingFile make_collection(const std::filesystem::path& path) {
  return {path,
          "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" "
          "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<Collection>\n",
          "</Collection>\n</VTKFile>\n"};
}

std::string collection_entry(double time, std::size_t part, const std::string& file) {
  return fmt::format("<DataSet timestep=\"{:.17g}\" part=\"{}\" file=\"{}\"/>\n", time, part,
                     xml_escape(file));
}

}  // namespace

Pictures::Pictures(const std::filesystem::path& folder, const std::string& stem,
                   std::vector<StructureMesh> meshes, const std::vector<std::string>& analyses)
    : folder_(folder),
      vtu_folder_(stem + "_vtu"),
      meshes_(std::move(meshes)),
      centres_(begin(stem)) {
  if (analyses.size() > 1) {
    for (const std::string& name : analyses) analyses_.push_back(file_part(name));
  }
  check_meshes(meshes_);
  make_folder(folder_ / vtu_folder_);
  for (const StructureMesh& mesh : meshes_) names_.push_back(mesh.name);
  make_skins();
  make_groups();
  const bool skinned =
      std::any_of(skins_.begin(), skins_.end(), [](const Skin& skin) { return !skin.empty(); });
  if (skinned) skins_listed_ = begin(stem + "_skin");
}

Pictures::Collections Pictures::begin(const std::string& stem) const {
  return {stem, std::make_unique<GrowingFile>(make_collection(folder_ / (stem + ".pvd"))), {}};
}

void Pictures::list(Collections& collections, int analysis, const std::string& entry) {
  collections.whole->add(entry);
  if (analyses_.empty()) return;
  auto part = collections.parts.find(analysis);
  if (part == collections.parts.end()) {
    const std::string& name = analyses_.at(static_cast<std::size_t>(analysis));
    const std::string file = collections.stem + "." + name + ".pvd";
    part = collections.parts.emplace(analysis, make_collection(folder_ / file)).first;
  }
  part->second.add(entry);
}

void Pictures::make_skins() {
  for (const StructureMesh& mesh : meshes_) {
    const Skin& skin = skins_.emplace_back(mesh);
    reference_skins_.push_back(skin.points(mesh.positions, mesh.triads));
  }
}

void Pictures::make_groups() {
  std::vector<std::string> types;
  std::set<std::string> parts;
  for (std::size_t s = 0; s < meshes_.size(); ++s) {
    const auto found = std::find(types.begin(), types.end(), meshes_[s].type);
    const auto g = static_cast<std::size_t>(found - types.begin());
    if (found == types.end()) {
      types.push_back(meshes_[s].type);
      // Types that differ only in characters that files cannot have get a number.
      std::string part = file_part(meshes_[s].type);
      while (!parts.insert(part).second) part += "_" + std::to_string(g);
      groups_.push_back({part, {}, {}});
    }
    groups_[g].structures.push_back(s);
    if (!skins_[s].empty()) groups_[g].skinned.push_back(s);
  }
}

void Pictures::add(const Picture& picture) {
  check_picture(meshes_, picture);
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    const Group& group = groups_[g];
    std::vector<VtuGrid> centres;
    std::vector<VtuGrid> skins;
    for (const std::size_t s : group.structures) {
      centres.push_back(centre_grid(meshes_[s], picture.structures[s], static_cast<int>(s)));
    }
    for (const std::size_t s : group.skinned) {
      skins.push_back(skin_grid(meshes_[s], picture.structures[s], static_cast<int>(s), skins_[s],
                                reference_skins_[s]));
    }
    const std::string file = stem(group, picture.index);
    write_picture(file + ".vtu", vtu_text(merge(centres), picture.time, names_));
    list(centres_, picture.analysis, collection_entry(picture.time, g, file + ".vtu"));
    if (skins.empty()) continue;
    write_picture(file + "_skin.vtu", vtu_text(merge(skins), picture.time, names_));
    list(*skins_listed_, picture.analysis, collection_entry(picture.time, g, file + "_skin.vtu"));
  }
}

void Pictures::write_picture(const std::string& file, const std::string& text) {
  replace_file(folder_ / file, text);
  written_.emplace_back(file, folder_ / file);
}

void Pictures::add_earlier(int index, double time, int analysis) {
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    const std::string file = stem(groups_[g], index);
    if (std::filesystem::exists(folder_ / (file + ".vtu"))) {
      list(centres_, analysis, collection_entry(time, g, file + ".vtu"));
    }
    if (!groups_[g].skinned.empty() && std::filesystem::exists(folder_ / (file + "_skin.vtu"))) {
      list(*skins_listed_, analysis, collection_entry(time, g, file + "_skin.vtu"));
    }
  }
}

std::string Pictures::stem(const Group& group, int index) const {
  return fmt::format("{}/{}_{}", vtu_folder_, group.file_part, step_name(index));
}

void Pictures::write() {
  for (const auto& [file, identity] : written_) identity.check_whole(folder_ / file);
  for (Collections* collections : {&centres_, skins_listed_ ? &*skins_listed_ : nullptr}) {
    if (collections == nullptr) continue;
    collections->whole->write();
    for (auto& [analysis, file] : collections->parts) file.write();
  }
}

}  // namespace culm::output
