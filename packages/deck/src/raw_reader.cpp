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
    list.name = required_attribute(element, "name", above);
    read_children(element, parent ? join_path(above, list.name) : "", list);
    report_duplicates(list, parent ? join_path(above, list.name) : "");
    return list;
  }

  void read_children(const XmlElement& element, const std::string& path, RawList& list) {
    report_text(element, path);
    for (const XmlElement& child : element.children) {
      if (child.name == "ParameterList") {
        list.lists.push_back(read_list(child, path));
      } else if (child.name == "Parameter") {
        list.parameters.push_back(
            read_parameter(child, {"name", "value", "type", "unit", "isDefault"}, path));
      } else if (child.name == "Variable") {
        list.variables.push_back(read_parameter(child, {"name", "value", "unit"}, path));
      } else if (child.name == "xi:include") {
        read_include(child, path, list);
      } else {
        report(child.line, path,
               "unknown element <" + child.name + ">" + did_you_mean(child.name, element_names));
      }
    }
  }

  RawParameter read_parameter(const XmlElement& element, const std::vector<std::string>& allowed,
                              const std::string& parent) {
    RawParameter parameter;
    parameter.file = file();
    parameter.line = element.line;
    parameter.name = required_attribute(element, "name", parent);
    const std::string path = parameter.name.empty() ? parent : join_path(parent, parameter.name);
    check_attributes(element, allowed, path);
    report_content(element, path);
    for (const XmlAttribute& attribute : element.attributes) {
      if (attribute.name == "value") parameter.value = attribute.value;
      if (attribute.name == "type") parameter.type = attribute.value;
      if (attribute.name == "unit") parameter.unit = attribute.value;
      if (attribute.name == "isDefault") parameter.is_default = attribute.value == "true";
    }
    return parameter;
  }

  void read_include(const XmlElement& element, const std::string& path, RawList& list) {
    check_attributes(element, {"href"}, path);
    report_content(element, path);
    const std::string href = required_attribute(element, "href", path);
    if (href.empty()) return;
    const std::string target =
        (std::filesystem::path(file()).parent_path() / href).lexically_normal().generic_string();
    if (std::ranges::find(files_, target) != files_.end()) {
      return report(element.line, path,
                    "'" + target + "' includes itself: " + join(files_, " → ") + " → " + target);
    }
    if (files_.size() > max_include_depth) {
      return report(element.line, path,
                    "includes are nested deeper than " + std::to_string(max_include_depth));
    }
    const std::optional<std::string> text = source_(target);
    if (!text) return report(element.line, path, "cannot read the included file '" + target + "'");
    // Files that include each other twice at every level would multiply without end.
    bytes_ += text->size();
    if (bytes_ > max_bytes) {
      return report(element.line, path, "the deck with its includes is larger than 64 MB");
    }
    files_.push_back(target);
    splice(*text, path, list);
    files_.pop_back();
  }

  /// The content of an included list of the same name joins `list`; any other becomes its child.
  void splice(const std::string& text, const std::string& path, RawList& list) {
    try {
      const XmlElement root = read_xml(text, file());
      if (root.name != "ParameterList") {
        report(root.line, path, "the root must be <ParameterList>, got <" + root.name + ">");
        return;
      }
      const auto name = std::ranges::find(root.attributes, "name", &XmlAttribute::name);
      if (name != root.attributes.end() && name->value == list.name) {
        check_attributes(root, {"name"}, path);
        read_children(root, path, list);
      } else {
        list.lists.push_back(read_list(root, path));
      }
    } catch (const InputError& error) {
      for (const InputIssue& issue : error.issues()) issues_.add(issue);
    }
  }

  std::string required_attribute(const XmlElement& element, const std::string& name,
                                 const std::string& path) {
    const auto found = std::ranges::find(element.attributes, name, &XmlAttribute::name);
    if (found == element.attributes.end()) {
      report(element.line, path, "<" + element.name + "> has no attribute '" + name + "'");
      return {};
    }
    if (trim(found->value).empty()) {
      report(element.line, path, "<" + element.name + "> has an empty attribute '" + name + "'");
    }
    return found->value;
  }

  void check_attributes(const XmlElement& element, const std::vector<std::string>& allowed,
                        const std::string& path) {
    for (const XmlAttribute& attribute : element.attributes) {
      if (std::ranges::find(allowed, attribute.name) != allowed.end()) continue;
      report(element.line, path,
             "unknown attribute '" + attribute.name + "' of <" + element.name + ">" +
                 did_you_mean(attribute.name, allowed));
    }
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
