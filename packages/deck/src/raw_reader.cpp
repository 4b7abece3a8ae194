#include <culm/base/error.hpp>
#include <culm/base/text.hpp>

#include "raw_list.hpp"
#include "xml_reader.hpp"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <map>
#include <utility>

namespace culm::deck {
namespace {

constexpr std::size_t max_include_depth = 16;

const std::vector<std::string> element_names = {"ParameterList", "Parameter", "Variable",
                                                "xi:include"};

/// Turns elements into raw lists, file by file.
class RawReader {
 public:
  RawReader(const TextSource& source, InputIssues& issues) : source_(source), issues_(issues) {}

  RawList read_deck(const std::string& text, const std::string& file) {
    files_ = {file};
    bytes_ = text.size();
    const XmlElement root = read_xml(text, file);
    if (root.name != "ParameterList") {
      throw InputError(Where{file, root.line, {}},
                       "the root must be <ParameterList>, got <" + root.name + ">");
    }
    return read_list(root, std::nullopt);
  }

 private:
  const std::string& file() const { return files_.back(); }

  void report(int line, const std::string& path, std::string message) {
    issues_.add(Where{file(), line, path}, std::move(message));
  }

  /// `parent` is the path of the enclosing list; the root has none and gives none to its children.
  RawList read_list(const XmlElement& element, const std::optional<std::string>& parent) {
    RawList list;
    list.file = file();
    list.line = element.line;
    const std::string above = parent.value_or("");
    check_attributes(element, {"name"}, above);
    list.name = required_attribute(element, "name", {"name"}, above);
    if (parent && list.name.find('/') != std::string::npos) {
      report(list.line, join_path(above, list.name),
             "a name must not contain '/', which stands between the names of a path");
    }
    read_children(element, parent ? join_path(above, list.name) : "", list);
    report_duplicates(list, parent ? join_path(above, list.name) : "");
    return list;
  }

  void read_children(const XmlElement& element, const std::string& path, RawList& list) {
    report_text(element, path);
    for (const XmlElement& child : element.children) {
      std::string name = child.name;
      if (std::ranges::find(element_names, name) == element_names.end()) {
        report(child.line, path,
               "unknown element <" + name + ">" + did_you_mean(name, element_names));
        // Read as what it was meant to be, so that nothing is missed below for its sake.
        name = nearest_name(name, element_names);
      }
      read_child(name, child, path, list);
    }
  }

  void read_child(const std::string& name, const XmlElement& child, const std::string& path,
                  RawList& list) {
    if (name == "ParameterList") {
      list.lists.push_back(read_list(child, path));
      list.is_incomplete |= list.lists.back().name.empty();
    } else if (name == "Parameter") {
      list.parameters.push_back(
          read_parameter(child, {"name", "value", "type", "unit", "isDefault"}, path));
      list.is_incomplete |= list.parameters.back().name.empty();
    } else if (name == "Variable") {
      list.variables.push_back(read_parameter(child, {"name", "value", "unit"}, path));
    } else if (name == "xi:include") {
      list.is_incomplete |= !read_include(child, path, list);
    } else {
      list.is_incomplete = true;
    }
  }

  RawParameter read_parameter(const XmlElement& element, const std::vector<std::string>& allowed,
                              const std::string& parent) {
    RawParameter parameter;
    parameter.file = file();
    parameter.line = element.line;
    parameter.name = required_attribute(element, "name", allowed, parent);
    const std::string path = parameter.name.empty() ? parent : join_path(parent, parameter.name);
    parameter.is_reported = !check_attributes(element, allowed, path);
    report_content(element, path);
    parameter.value = find_attribute(element, "value", allowed);
    parameter.type = find_attribute(element, "type", allowed);
    parameter.unit = find_attribute(element, "unit", allowed);
    parameter.is_default = find_attribute(element, "isDefault", allowed) == "true";
    return parameter;
  }

  /// Returns whether all of it could be read.
  bool read_include(const XmlElement& element, const std::string& path, RawList& list) {
    check_attributes(element, {"href"}, path);
    report_content(element, path);
    const std::string href = required_attribute(element, "href", {"href"}, path);
    if (href.empty()) return false;
    const std::string target =
        (std::filesystem::path(file()).parent_path() / href).lexically_normal().generic_string();
    if (std::ranges::find(files_, target) != files_.end()) {
      report(element.line, path,
             "'" + target + "' includes itself: " + join(files_, " → ") + " → " + target);
      return false;
    }
    if (files_.size() > max_include_depth) {
      report(element.line, path,
             "includes are nested deeper than " + std::to_string(max_include_depth));
      return false;
    }
    const FileText included = source_(target);
    if (!included.objection.empty()) {
      report(element.line, path,
             "cannot read the included file '" + target + "': " + included.objection);
      return false;
    }
    // Files that include each other twice at every level would multiply without end.
    bytes_ += included.text.size();
    if (bytes_ > max_bytes) {
      report(element.line, path, "the deck with its includes is larger than 64 MB");
      return false;
    }
    files_.push_back(target);
    const bool is_whole = splice(included.text, path, list);
    files_.pop_back();
    return is_whole;
  }

  /// The content of an included list of the same name joins `list`; any other becomes its child.
  /// Returns whether there is such a list.
  bool splice(const std::string& text, const std::string& path, RawList& list) {
    try {
      const XmlElement root = read_xml(text, file());
      if (root.name != "ParameterList") {
        report(root.line, path, "the root must be <ParameterList>, got <" + root.name + ">");
        return false;
      }
      const auto name = std::ranges::find(root.attributes, "name", &XmlAttribute::name);
      if (name != root.attributes.end() && name->value == list.name) {
        check_attributes(root, {"name"}, path);
        read_children(root, path, list);
      } else {
        list.lists.push_back(read_list(root, path));
      }
      return true;
    } catch (const InputError& error) {
      for (const InputIssue& issue : error.issues()) issues_.add(issue);
      return false;
    }
  }

  static bool is_known(const XmlAttribute& attribute, const std::vector<std::string>& allowed) {
    return std::ranges::find(allowed, attribute.name) != allowed.end();
  }

  /// The attribute of this name, or one that was meant to have it, which is a mistake of its own.
  static std::optional<std::string> find_attribute(const XmlElement& element,
                                                   const std::string& name,
                                                   const std::vector<std::string>& allowed) {
    const auto found = std::ranges::find(element.attributes, name, &XmlAttribute::name);
    if (found != element.attributes.end()) return found->value;
    for (const XmlAttribute& attribute : element.attributes) {
      if (is_known(attribute, allowed)) continue;
      if (nearest_name(attribute.name, allowed) == name) return attribute.value;
    }
    return std::nullopt;
  }

  std::string required_attribute(const XmlElement& element, const std::string& name,
                                 const std::vector<std::string>& allowed, const std::string& path) {
    const std::optional<std::string> found = find_attribute(element, name, allowed);
    if (!found) {
      // An unknown attribute, which is a mistake of its own, may be this one.
      const bool all_known = std::ranges::all_of(
          element.attributes, [&](const auto& attribute) { return is_known(attribute, allowed); });
      if (all_known) {
        report(element.line, path, "<" + element.name + "> has no attribute '" + name + "'");
      }
      return {};
    }
    if (trim(*found).empty()) {
      report(element.line, path, "<" + element.name + "> has an empty attribute '" + name + "'");
    }
    return *found;
  }

  /// Returns whether all attributes are known.
  bool check_attributes(const XmlElement& element, const std::vector<std::string>& allowed,
                        const std::string& path) {
    bool all_known = true;
    for (const XmlAttribute& attribute : element.attributes) {
      if (is_known(attribute, allowed)) continue;
      all_known = false;
      report(element.line, path,
             "unknown attribute '" + attribute.name + "' of <" + element.name + ">" +
                 did_you_mean(attribute.name, allowed));
    }
    return all_known;
  }

  void report_text(const XmlElement& element, const std::string& path) {
    if (element.stray_text.empty()) return;
    constexpr std::size_t shown = 40;
    const bool is_long = element.stray_text.size() > shown;
    report(element.stray_line, path,
           "text between elements is not allowed: '" + element.stray_text.substr(0, shown) +
               (is_long ? "…'" : "'"));
  }

  void report_content(const XmlElement& element, const std::string& path) {
    report_text(element, path);
    if (element.children.empty()) return;
    report(element.children.front().line, path, "<" + element.name + "> must be empty");
  }

  void report_duplicates(const RawList& list, const std::string& path) {
    std::map<std::string, Where> seen;
    const auto visit = [&](const auto& items) {
      for (const auto& item : items) {
        if (item.name.empty()) continue;
        const Where where{item.file, item.line, join_path(path, item.name)};
        const auto [first, is_new] = seen.emplace(item.name, where);
        if (is_new) continue;
        const bool same_file = first->second.file == item.file;
        issues_.add(
            where,
            "duplicate name, first used " +
                (same_file ? "in line " + std::to_string(first->second.line)
                           : "at " + to_string(Where{first->second.file, first->second.line, {}})));
      }
    };
    visit(list.parameters);
    visit(list.lists);
    seen.clear();
    visit(list.variables);
  }

  const TextSource& source_;
  InputIssues& issues_;
  std::vector<std::string> files_;  ///< the file being read, after those that include it
  std::size_t bytes_ = 0;
};

}  // namespace

RawList read_raw(const std::string& text, const std::string& file, const TextSource& includes,
                 InputIssues& issues) {
  return RawReader(includes, issues).read_deck(text, file);
}

}  // namespace culm::deck
