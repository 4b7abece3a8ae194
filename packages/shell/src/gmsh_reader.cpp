#include <culm/base/error.hpp>
#include <culm/shell/gmsh_reader.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <string_view>
#include <unordered_map>
#include <utility>

namespace culm::shell {

namespace {

constexpr int type_line = 1;
constexpr int type_quad = 3;
constexpr int type_point = 15;

// Words of the file with their line, for messages.
class Words {
 public:
  Words(std::string_view text, std::string path) : text_(text), path_(std::move(path)) {}

  [[noreturn]] void fail(const std::string& message) const {
    throw FileError(path_, fmt::format("line {}: {}", line_, message));
  }
  bool at_end() {
    skip_space();
    return position_ == text_.size();
  }
  std::string_view word() {
    if (at_end()) fail("the file ends too early");
    const std::size_t begin = position_;
    while (position_ < text_.size() && !is_space(text_[position_])) ++position_;
    return text_.substr(begin, position_ - begin);
  }
  /// A name between quotation marks.
  std::string name() {
    if (at_end() || text_[position_] != '"') fail("expected a name in quotation marks");
    const std::size_t end = text_.find('"', position_ + 1);
    if (end == std::string_view::npos) fail("a name without closing quotation mark");
    const std::string_view found = text_.substr(position_ + 1, end - position_ - 1);
    position_ = end + 1;
    return std::string(found);
  }
  template <class Number>
  Number number() {
    const std::string_view found = word();
    Number value{};
    const auto [rest, error] = std::from_chars(found.data(), found.data() + found.size(), value);
    if (error != std::errc() || rest != found.data() + found.size()) {
      fail(fmt::format("expected a number, found '{}'", found));
    }
    return value;
  }
  std::int64_t integer() { return number<std::int64_t>(); }
  Vec3 vector() {
    const auto x = number<double>();
    const auto y = number<double>();
    return {x, y, number<double>()};
  }
  void expect(std::string_view what) {
    const std::string_view found = word();
    if (found != what) fail(fmt::format("expected {}, found '{}'", what, found));
  }
  void skip_to(std::string_view what) {
    while (word() != what) {
    }
  }

 private:
  static bool is_space(char c) { return c == ' ' || c == '\n' || c == '\t' || c == '\r'; }
  void skip_space() {
    while (position_ < text_.size() && is_space(text_[position_])) {
      if (text_[position_++] == '\n') ++line_;
    }
  }

  std::string_view text_;
  std::string path_;
  std::size_t position_ = 0;
  int line_ = 1;
};

using Tag = std::int64_t;
using DimensionAndTag = std::pair<int, Tag>;

// A line or a point of a physical group, by its points.
struct Trace {
  std::string group;
  std::vector<int> points;
};

class Reader {
 public:
  Reader(const std::string& text, const std::string& path) : words_(text, path) {}

  Facets read() {
    words_.expect("$MeshFormat");
    const std::string version(words_.word());
    if (version != "2.2" && version != "4.1") {
      words_.fail("is in format MSH " + version + "; save it as 2.2 or 4.1");
    }
    if (words_.integer() != 0) words_.fail("is binary; save it as ASCII");
    words_.skip_to("$EndMeshFormat");
    const bool old = version == "2.2";
    while (!words_.at_end()) {
      const std::string section(words_.word());
      if (section == "$PhysicalNames") {
        read_names();
      } else if (section == "$Entities" && !old) {
        read_entities();
      } else if (section == "$Nodes") {
        old ? read_nodes_2() : read_nodes_4();
      } else if (section == "$Elements") {
        old ? read_elements_2() : read_elements_4();
      } else if (section.starts_with("$")) {
        words_.skip_to("$End" + section.substr(1));
        continue;
      } else {
        words_.fail("expected the start of a section, found '" + section + "'");
      }
      words_.expect("$End" + section.substr(1));
    }
    if (facets_.quads.empty()) words_.fail("there are no quadrilaterals in the mesh");
    add_normals();
    add_edges();
    return std::move(facets_);
  }

 private:
  void read_names() {
    for (Tag i = words_.integer(); i > 0; --i) {
      const int dimension = static_cast<int>(words_.integer());
      const Tag tag = words_.integer();
      names_[{dimension, tag}] = words_.name();
    }
  }

  std::string group_name(int dimension, Tag physical) const {
    const auto found = names_.find({dimension, physical});
    return found == names_.end() ? std::to_string(physical) : found->second;
  }

  // MSH 4: the physical groups of each entity
  void read_entities() {
    std::array<Tag, 4> counts{};
    for (Tag& count : counts) count = words_.integer();
    for (int dimension = 0; dimension < 4; ++dimension) {
      for (Tag i = 0; i < counts[static_cast<std::size_t>(dimension)]; ++i) {
        const Tag entity = words_.integer();
        for (int skipped = 0; skipped < (dimension == 0 ? 3 : 6); ++skipped) words_.word();
        for (Tag n = words_.integer(); n > 0; --n) {
          groups_[{dimension, entity}].push_back(group_name(dimension, words_.integer()));
        }
        if (dimension == 0) continue;
        for (Tag n = words_.integer(); n > 0; --n) words_.word();
      }
    }
  }

  void add_node(Tag tag, const Vec3& x) {
    const auto [place, is_new] = points_.try_emplace(tag, static_cast<int>(facets_.points.size()));
    if (!is_new) words_.fail(fmt::format("node {} is there twice", tag));
    facets_.points.push_back(x);
  }

  void read_nodes_2() {
    for (Tag i = words_.integer(); i > 0; --i) {
      const Tag tag = words_.integer();
      add_node(tag, words_.vector());
    }
  }

  void read_nodes_4() {
    const Tag blocks = words_.integer();
    for (int skipped = 0; skipped < 3; ++skipped) words_.integer();
    for (Tag block = 0; block < blocks; ++block) {
      const Tag dimension = words_.integer();
      words_.integer();
      const bool parametric = words_.integer() != 0;
      const Tag count = words_.integer();
      std::vector<Tag> tags;
      for (Tag i = 0; i < count; ++i) tags.push_back(words_.integer());
      for (const Tag tag : tags) {
        add_node(tag, words_.vector());
        for (Tag i = 0; parametric && i < dimension; ++i) words_.word();
      }
    }
  }

  int read_point() {
    const Tag tag = words_.integer();
    const auto found = points_.find(tag);
    if (found == points_.end()) words_.fail(fmt::format("there is no node {}", tag));
    return found->second;
  }

  // The nodes of an element follow.
  void read_element(Tag element, int type, const std::vector<std::string>& groups) {
    if (type == type_quad) {
      std::array<int, 4> quad{};
      for (int& point : quad) point = read_point();
      // MSH 2 writes an element once for each physical group that it is in
      std::array<int, 4> points = quad;
      std::sort(points.begin(), points.end());
      const auto [known, is_new] =
          quads_.try_emplace(points, static_cast<int>(facets_.quads.size()));
      if (is_new) facets_.quads.push_back(quad);
      for (const std::string& group : groups) {
        std::vector<int>& part = facets_.parts[group];
        if (part.empty() || part.back() != known->second) part.push_back(known->second);
      }
    } else if (type == type_line || type == type_point) {
      std::vector<int> points{read_point()};
      if (type == type_line) points.push_back(read_point());
      for (const std::string& group : groups) {
        refuse_other_dimension(group, type);
        traces_.push_back({group, points});
      }
    } else {
      words_.fail(
          fmt::format("element {} is of type {}; shells are made of four-node "
                      "quadrilaterals (type 3): recombine triangles, order 1",
                      element, type));
    }
  }

  // Loads and supports name both in one way, and Gmsh counts physical points and curves each
  // from 1.
  void refuse_other_dimension(const std::string& group, int type) {
    if (group == "all")
      words_.fail("a physical group is called 'all', as all nodes are: rename it");
    if (types_.try_emplace(group, type).first->second == type) return;
    words_.fail(
        fmt::format("a physical point and a physical curve are both called '{0}': give "
                    "them names of their own, as in Physical Curve(\"side {0}\")",
                    group));
  }

  void read_elements_2() {
    for (Tag i = words_.integer(); i > 0; --i) {
      const Tag element = words_.integer();
      const int type = static_cast<int>(words_.integer());
      const int dimension = type == type_point ? 0 : type == type_line ? 1 : 2;
      std::vector<std::string> groups;
      const Tag tags = words_.integer();
      for (Tag t = 0; t < tags; ++t) {
        const Tag tag = words_.integer();
        if (t == 0 && tag != 0) groups.push_back(group_name(dimension, tag));
      }
      read_element(element, type, groups);
    }
  }

  void read_elements_4() {
    const Tag blocks = words_.integer();
    for (int skipped = 0; skipped < 3; ++skipped) words_.integer();
    for (Tag block = 0; block < blocks; ++block) {
      const int dimension = static_cast<int>(words_.integer());
      const std::vector<std::string>& groups = groups_[{dimension, words_.integer()}];
      const int type = static_cast<int>(words_.integer());
      for (Tag count = words_.integer(); count > 0; --count) {
        read_element(words_.integer(), type, groups);
      }
    }
  }

  void add_normals() {
    for (const auto& quad : facets_.quads) {
      std::array<Vec3, 4> points;
      for (std::size_t c = 0; c < 4; ++c) {
        points[c] = facets_.points[static_cast<std::size_t>(quad[c])];
      }
      facets_.normals.push_back(corner_normals(points));
    }
  }

  // A line belongs to all quadrilaterals that have both its ends, a point to all that have it.
  void add_edges() {
    std::unordered_map<int, std::vector<Corner>> around;
    for (std::size_t q = 0; q < facets_.quads.size(); ++q) {
      for (int c = 0; c < 4; ++c) {
        around[facets_.quads[q][static_cast<std::size_t>(c)]].push_back({static_cast<int>(q), c});
      }
    }
    for (const Trace& trace : traces_) {
      std::vector<Corner>& edge = facets_.edges[trace.group];
      if (trace.points.size() == 1) facets_.points_only.insert(trace.group);
      for (const int point : trace.points) {
        for (const Corner& corner : around[point]) {
          const auto& quad = facets_.quads[static_cast<std::size_t>(corner.quad)];
          const bool has_all = std::all_of(
              trace.points.begin(), trace.points.end(),
              [&](int other) { return std::find(quad.begin(), quad.end(), other) != quad.end(); });
          if (has_all) edge.push_back(corner);
        }
      }
    }
  }

  Words words_;
  std::map<DimensionAndTag, std::string> names_;
  std::map<DimensionAndTag, std::vector<std::string>> groups_;  // of entities
  std::unordered_map<Tag, int> points_;
  std::map<std::array<int, 4>, int> quads_;  // numbers by their points, which rise
  std::vector<Trace> traces_;
  std::map<std::string, int> types_;  // of the elements in groups of points and curves
  Facets facets_;
};

}  // namespace

Facets read_gmsh(const std::string& text, const std::string& path) {
  return Reader(text, path).read();
}

}  // namespace culm::shell
