#include <culm/base/text.hpp>
#include <culm/deck/relax_ng.hpp>

#include "convert.hpp"
#include "describe.hpp"
#include "xml_text.hpp"

#include <cctype>
#include <map>
#include <sstream>
#include <utility>

namespace culm::deck {
namespace {

/// <name attributes>content</name>, the content in lines of its own.
std::string element(const std::string& name, const std::string& attributes,
                    const std::string& content) {
  const std::string start = "<" + name + (attributes.empty() ? "" : " " + attributes);
  if (content.empty()) return start + "/>\n";
  std::string text = start + ">\n";
  std::istringstream lines(content);
  for (std::string line; std::getline(lines, line);) text += "  " + line + "\n";
  return text + "</" + name + ">\n";
}

std::string named(const std::string& name) { return "name=\"" + escaped(name) + "\""; }

/// A pattern for exactly this text.
std::string exactly(const std::string& text) {
  return "<value type=\"string\">" + escaped(text) + "</value>\n";
}

std::string one_of(const std::vector<std::string>& texts) {
  std::string patterns;
  for (const std::string& text : texts) patterns += exactly(text);
  return texts.size() == 1 ? patterns : element("choice", "", patterns);
}

std::string param(const std::string& name, const std::string& value) {
  return "<param name=\"" + name + "\">" + escaped(value) + "</param>\n";
}

/// Texts that match an expression of XML Schema.
std::string matching(const std::string& expression, const std::string& except = {}) {
  return element("data", "type=\"string\"",
                 param("pattern", expression) +
                     (except.empty() ? "" : element("except", "", element("choice", "", except))));
}

std::string attribute(const std::string& name, const std::string& pattern) {
  return element("attribute", named(name), pattern);
}

std::string optional(const std::string& pattern) { return element("optional", "", pattern); }

/// Numbers of this kind in digits, not as expressions, that are not allowed.
std::string outside(const Field& field, const std::string& type) {
  const auto literals = [&](const std::string& rule, double value) {
    return element("data", "type=\"" + type + "\"", param(rule, format_number(value)));
  };
  // A unit may scale a number, but leaves its sign.
  const auto is_known = [&](const Bound& bound) {
    return field.kind() == Kind::integer || bound.value == 0.0;
  };
  std::string patterns;
  if (field.lower() && is_known(*field.lower())) {
    patterns +=
        literals(field.lower()->inclusive ? "maxExclusive" : "maxInclusive", field.lower()->value);
  }
  if (field.upper() && is_known(*field.upper())) {
    patterns +=
        literals(field.upper()->inclusive ? "minExclusive" : "minInclusive", field.upper()->value);
  }
  return patterns;
}

/// A number, by digits or an expression: "3 apples" and "inf" are neither.
std::string number_pattern(const Field& field) {
  const bool is_integer = field.kind() == Kind::integer;
  std::string except =
      matching(".*[0-9.]\\s+[A-Za-z_].*") +
      matching("\\s*[+\\-]?([nN][aA][nN]|[iI][nN][fF]([iI][nN][iI][tT][yY])?)\\s*");
  if (is_integer) except += matching("\\s*[+\\-]?[0-9]*\\.[0-9]*[1-9][0-9]*\\s*");
  return matching(".*\\S.*", except + outside(field, "double"));
}

/// The characters of a text for an expression of XML Schema.
std::string literally(const std::string& text) {
  std::string expression;
  for (const char symbol : text) {
    if (std::string_view(".\\?*+{}()[]|-^").find(symbol) != std::string_view::npos) {
      expression += '\\';
    }
    expression += symbol;
  }
  return expression;
}

std::string array_pattern(const Field& field) {
  if (field.choices().empty()) return matching("\\s*\\{.*\\}\\s*");
  std::vector<std::string> choices;
  for (const std::string& one : field.choices()) choices.push_back(literally(one));
  const std::string item = "\\s*\"?(" + join(choices, "|") + ")\"?\\s*";
  return matching("\\s*\\{(\\s*|" + item + "(," + item + ")*)\\}\\s*");
}

std::string value_pattern(const Field& field) {
  switch (field.kind()) {
    case Kind::number:
    case Kind::integer:
      return number_pattern(field);
    case Kind::flag:
      return element("choice", "",
                     "<value type=\"token\">true</value>\n<value type=\"token\">false</value>\n");
    case Kind::text:
      return field.choices().empty() ? "<text/>\n" : one_of(field.choices());
    case Kind::numbers:
    case Kind::integers:
    case Kind::texts:
      return array_pattern(field);
  }
  return {};
}

std::string documentation(const std::string& text) {
  return text.empty() ? "" : "<a:documentation>" + escaped(text) + "</a:documentation>\n";
}

std::string parameter(const std::string& doc, const std::string& name, const std::string& value,
                      Kind kind) {
  const bool has_unit = kind == Kind::number || kind == Kind::numbers;
  return element("element", named("Parameter"),
                 documentation(doc) + attribute("name", exactly(name)) + attribute("value", value) +
                     optional(attribute("type", exactly(type_name(kind)))) +
                     (has_unit ? optional(attribute("unit", "")) : "") +
                     optional(attribute("isDefault", "")));
}

std::string list_element(const std::string& name_pattern, const std::string& doc,
                         const std::string& content) {
  return element("element", named("ParameterList"),
                 documentation(doc) + attribute("name", name_pattern) + content);
}

std::string any_number_of(const std::string& pattern) { return element("zeroOrMore", "", pattern); }

/// What a deck says once and for all.
constexpr const char* common = R"(<define name="variable">
  <element name="Variable">
    <a:documentation>A number for expressions here, and in all lists below.</a:documentation>
    <attribute name="name"><data type="string"><param name="pattern">[A-Za-z_][A-Za-z0-9_]*</param></data></attribute>
    <attribute name="value"/>
    <optional><attribute name="unit"/></optional>
  </element>
</define>
<define name="include">
  <element name="xi:include">
    <a:documentation>Puts another file in place.</a:documentation>
    <attribute name="href"/>
  </element>
</define>
<define name="anything">
  <a:documentation>In a list whose type stands in an included file.</a:documentation>
  <choice>
    <element name="Parameter"><zeroOrMore><attribute><anyName/></attribute></zeroOrMore></element>
    <element name="ParameterList">
      <attribute name="name"/>
      <zeroOrMore><choice><ref name="anything"/><ref name="variable"/><ref name="include"/></choice></zeroOrMore>
    </element>
  </choice>
</define>
<define name="included">
  <zeroOrMore><choice><ref name="anything"/><ref name="variable"/></choice></zeroOrMore>
  <ref name="include"/>
  <zeroOrMore><choice><ref name="anything"/><ref name="variable"/><ref name="include"/></choice></zeroOrMore>
</define>
)";

/// Makes one definition of each distinct pattern.
class Grammar {
 public:
  std::string write(const Schema& root) {
    std::string start = list(exactly(root.name()), root.name(), root);
    for (const Schema::Slot& slot : root.lists()) start += slot_list(slot, root);
    const std::string content = element("start", "", element("choice", "", start)) + common;
    return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n" +
           element("grammar",
                   "xmlns=\"http://relaxng.org/ns/structure/1.0\"\n"
                   "    xmlns:a=\"http://relaxng.org/ns/compatibility/annotations/1.0\"\n"
                   "    xmlns:xi=\"http://www.w3.org/2001/XInclude\"\n"
                   "    datatypeLibrary=\"http://www.w3.org/2001/XMLSchema-datatypes\"",
                   content + definitions_);
  }

 private:
  /// A reference to a definition with this content, which is made if there is none.
  std::string define(const std::string& title, const std::string& content) {
    const auto [known, is_new] = names_.emplace(std::pair(title, content), std::string());
    if (is_new) {
      known->second = free_name(title);
      definitions_ += element("define", named(known->second), content);
    }
    return "<ref " + named(known->second) + "/>\n";
  }

  std::string free_name(const std::string& title) {
    std::string name = "_";
    for (const char symbol : title) {
      const bool plain = std::isalnum(static_cast<unsigned char>(symbol)) != 0;
      name += plain ? std::string(1, symbol) : ".";
    }
    const int count = ++uses_[name];
    return count == 1 ? name : name + "-" + std::to_string(count);
  }

  /// All that may stand in a list but `Type`, in any order.
  std::string items(const std::string& title, const Schema& schema) {
    std::string choices = "<ref name=\"variable\"/>\n<ref name=\"include\"/>\n";
    for (const Field& field : schema.fields()) {
      choices += define(field.name(), parameter(describe_fully(field), field.name(),
                                                value_pattern(field), field.kind()));
    }
    for (const Schema::Slot& slot : schema.lists()) choices += slot_list(slot, schema);
    if (schema.entries()) choices += slot_list(*schema.entries(), schema);
    return any_number_of(define(title + ".item", element("choice", "", choices)));
  }

  std::string list(const std::string& name_pattern, const std::string& title,
                   const Schema& schema) {
    return define(title, list_element(name_pattern, schema.doc(), items(title, schema)));
  }

  std::string slot_list(const Schema::Slot& slot, const Schema& parent) {
    const std::string name = slot.name.empty() ? own_name(parent) : exactly(slot.name);
    const std::string title = slot.name.empty() ? parent.name() + ".entry" : slot.name;
    if (!slot.by_type()) return list(name, title, *slot.schema);
    std::string choices;
    for (const auto& [type, schema] : *slot.variants) choices += typed(type, schema);
    if (!slot.default_type.empty()) {
      choices += items(slot.default_type, *slot.find(slot.default_type));
    }
    choices += "<ref name=\"included\"/>\n";
    return define(title, list_element(name, "", element("choice", "", choices)));
  }

  /// The content of a list of this type, which stands anywhere in it.
  std::string typed(const std::string& type, const Schema& schema) {
    const std::string others = items(type, schema);
    const std::string chooses =
        define("Type." + type, parameter(schema.doc(), "Type", exactly(type), Kind::text));
    return define(type, element("group", "", others + chooses + others));
  }

  /// Names that the user may give: not those that mean something else in this list.
  static std::string own_name(const Schema& parent) {
    std::vector<std::string> taken = parent.field_names();
    for (const std::string& list : parent.list_names()) taken.push_back(list);
    return element(
        "data", "type=\"string\"",
        param("pattern", ".*\\S.*") + (taken.empty() ? "" : element("except", "", one_of(taken))));
  }

  std::map<std::pair<std::string, std::string>, std::string> names_;  ///< by title and content
  std::map<std::string, int> uses_;
  std::string definitions_;
};

}  // namespace

std::string relax_ng(const Schema& root) { return Grammar().write(root); }

}  // namespace culm::deck
