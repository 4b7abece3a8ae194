#include <culm/base/error.hpp>
#include <culm/output/vtu.hpp>

#include "names.hpp"
#include "picture_grids.hpp"
#include "replace_file.hpp"
#include "vtu_grid.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <set>
#include <system_error>
#include <utility>

namespace culm::output {

namespace {

GrowingFile make_collection(const std::filesystem::path& path) {
  return {path,
          "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" "
          "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<Collection>\n",
          "</Collection>\n</VTKFile>\n"};
}

std::vector<std::string> collection_entries(
    double time, const std::vector<std::pair<std::size_t, std::string>>& files) {
  std::vector<std::string> entries;
  for (const auto& [part, file] : files) {
    entries.push_back(fmt::format("<DataSet timestep=\"{:.17g}\" part=\"{}\" file=\"{}\"/>\n", time,
                                  part, xml_escape(file)));
  }
  return entries;
}

}  // namespace

Pictures::Pictures(const std::filesystem::path& folder, const std::string& stem,
                   std::vector<StructureMesh> meshes, const std::vector<std::string>& analyses,
                   std::size_t most)
    : folder_(folder),
      vtu_folder_(stem + "_vtu"),
      meshes_(std::move(meshes)),
      most_(most),
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

void Pictures::list(Collections& collections, int analysis, const Step& step, const Files& files) {
  const std::vector<std::string> entries = collection_entries(step.time, files);
  for (const std::string& entry : entries) collections.whole->add(entry);
  if (analyses_.empty() || entries.empty()) return;
  auto part = collections.parts.find(analysis);
  if (part == collections.parts.end()) {
    const std::string& name = analyses_.at(static_cast<std::size_t>(analysis));
    const std::string file = collections.stem + "." + name + ".pvd";
    part = collections.parts.emplace(analysis, make_collection(folder_ / file)).first;
  }
  for (const std::string& entry : entries) part->second.add(entry);
}

void Pictures::list_anew(Collections& collections, Files Step::*files) {
  std::vector<std::string> all;
  for (const auto& [analysis, sequence] : sequences_) {
    std::vector<std::string> own;
    for (const Step& step : sequence.shown) {
      for (std::string& entry : collection_entries(step.time, step.*files)) {
        own.push_back(std::move(entry));
      }
    }
    all.insert(all.end(), own.begin(), own.end());
    const auto part = collections.parts.find(analysis);
    if (part != collections.parts.end()) part->second.replace(own);
  }
  collections.whole->replace(all);
}

// Nothing but skins asks for triads of the reference, which take most of the memory of a mesh.
void Pictures::make_skins() {
  for (StructureMesh& mesh : meshes_) {
    const Skin& skin = skins_.emplace_back(mesh);
    reference_skins_.push_back(skin.points(mesh.positions, mesh.triads));
    // {} would keep the memory
    mesh.triads = std::vector<Mat3>();
    mesh.outlines = std::vector<std::vector<Eigen::Vector2d>>();
  }
}

void Pictures::make_groups() {
  std::vector<std::string> types;
  std::set<std::string> parts;
  for (std::size_t s = 0; s < names_.size(); ++s) {
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

bool Pictures::shows_next(int analysis) const {
  const auto found = sequences_.find(analysis);
  Thinning next = found == sequences_.end() ? Thinning(most_) : found->second.thinning;
  return next.choose_next();
}

void Pictures::add(const Picture& picture) {
  Step step;
  step.time = picture.time;
  add(picture.analysis, std::move(step), &picture);
}

void Pictures::add_earlier(int index, double time, int analysis) {
  Step step;
  step.time = time;
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    const std::string file = stem(groups_[g], index);
    const auto add_existing = [&](Files& files, const std::string& name) {
      if (std::filesystem::exists(folder_ / name)) files.emplace_back(g, name);
    };
    add_existing(step.centres, file + ".vtu");
    if (!groups_[g].skinned.empty()) add_existing(step.skins, file + "_skin.vtu");
  }
  add(analysis, std::move(step), nullptr);
}

// @param picture  none where the files are there
void Pictures::add(int analysis, Step step, const Picture* picture) {
  if (waiting_ && waiting_->analysis != analysis) settle();
  if (waiting_) remove_files(waiting_->step);
  waiting_.reset();
  Sequence& sequence =
      sequences_.try_emplace(analysis, Sequence{Thinning(most_), {}}).first->second;
  step.number = sequence.thinning.count();
  const std::size_t stride = sequence.thinning.stride();
  const bool is_shown = sequence.thinning.choose_next();
  if (sequence.thinning.stride() != stride) thin_out(sequence);
  if (!is_shown) {
    waiting_ = {analysis, std::move(step), picture == nullptr};
    return;
  }
  if (picture != nullptr) write_files(*picture, step);
  show(analysis, std::move(step));
}

void Pictures::show(int analysis, Step step) {
  list(centres_, analysis, step, step.centres);
  if (skins_listed_) list(*skins_listed_, analysis, step, step.skins);
  sequences_.at(analysis).shown.push_back(std::move(step));
}

void Pictures::draw(const Picture& last) {
  internal_check(lacks_last(), "a step waits for its picture");
  write_files(last, waiting_->step);
  waiting_->is_drawn = true;
}

// The last step of an analysis is shown whatever its number.
void Pictures::settle() {
  if (!waiting_) return;
  internal_check(waiting_->is_drawn, "the last step was drawn");
  show(waiting_->analysis, std::move(waiting_->step));
  waiting_.reset();
}

// No collection ever names a file that is gone.
void Pictures::thin_out(Sequence& sequence) {
  std::vector<Step> kept, gone;
  for (Step& step : sequence.shown) {
    (sequence.thinning.keeps(step.number) ? kept : gone).push_back(std::move(step));
  }
  sequence.shown = std::move(kept);
  list_anew(centres_, &Step::centres);
  if (skins_listed_) list_anew(*skins_listed_, &Step::skins);
  for (const Step& step : gone) remove_files(step);
}

void Pictures::remove_files(const Step& step) {
  for (const Files* files : {&step.centres, &step.skins}) {
    for (const auto& [part, file] : *files) {
      std::error_code ignored;  // whoever took it away already
      std::filesystem::remove(folder_ / file, ignored);
      written_.erase(file);
    }
  }
}

void Pictures::write_files(const Picture& picture, Step& step) {
  check_picture(meshes_, picture);
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    const Group& group = groups_[g];
    std::vector<VtuGrid> centres;
    for (const std::size_t s : group.structures) {
      centres.push_back(centre_grid(meshes_[s], picture.structures[s], static_cast<int>(s)));
    }
    const std::string file = stem(group, picture.index);
    write_picture(file + ".vtu", merge(std::move(centres)), picture.time);
    step.centres.emplace_back(g, file + ".vtu");
    if (group.skinned.empty()) continue;
    std::vector<VtuGrid> skins;
    for (const std::size_t s : group.skinned) {
      const StructureState& state = picture.structures[s];
      skins.push_back(
          skin_grid(meshes_[s], state, static_cast<int>(s), skins_[s],
                    state.reference_positions.empty()
                        ? reference_skins_[s]
                        : skins_[s].points(state.reference_positions, state.reference_triads)));
    }
    write_picture(file + "_skin.vtu", merge(std::move(skins)), picture.time);
    step.skins.emplace_back(g, file + "_skin.vtu");
  }
}

void Pictures::write_picture(const std::string& file, const VtuGrid& grid, double time) {
  write_vtu(folder_ / file, grid, time, names_);
  written_.insert_or_assign(file, FileIdentity(folder_ / file));
}

std::string Pictures::stem(const Group& group, int index) const {
  return fmt::format("{}/{}_{}", vtu_folder_, group.file_part, step_name(index));
}

void Pictures::write() {
  settle();
  for (const auto& [file, identity] : written_) identity.check_whole(folder_ / file);
  for (Collections* collections : {&centres_, skins_listed_ ? &*skins_listed_ : nullptr}) {
    if (collections == nullptr) continue;
    collections->whole->write();
    for (auto& [analysis, file] : collections->parts) file.write();
  }
}

std::size_t Pictures::shown() const {
  std::size_t shown = 0;
  for (const auto& [analysis, sequence] : sequences_) shown += sequence.shown.size();
  return shown;
}

std::size_t Pictures::added() const {
  std::size_t added = 0;
  for (const auto& [analysis, sequence] : sequences_) added += sequence.thinning.count();
  return added;
}

}  // namespace culm::output
