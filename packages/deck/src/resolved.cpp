#include <culm/deck/resolved.hpp>

#include "array_text.hpp"
#include "convert.hpp"
#include "xml_text.hpp"

namespace culm::deck {
namespace {

std::string value_text(const Value& value) {
  const auto* texts = std::get_if<std::vector<std::string>>(&value);
  return escaped(texts ? join_array(*texts) : to_string(value));
}

void write(const Options& options, const std::string& indent, std::string& xml) {
  xml += indent + "<ParameterList name=\"" + escaped(options.name()) + "\">\n";
  for (const Options::Parameter& parameter : options.parameters()) {
    if (!parameter.value) continue;
    xml += indent + "  <Parameter name=\"" + escaped(parameter.name) + "\" type=\"" +
           type_name(kind_of(*parameter.value)) + "\" value=\"" + value_text(*parameter.value) +
           (parameter.given ? "\"/>\n" : "\" isDefault=\"true\"/>\n");
  }
  for (const Options& list : options.lists()) write(list, indent + "  ", xml);
  for (const Options& entry : options.entries()) write(entry, indent + "  ", xml);
  xml += indent + "</ParameterList>\n";
}

}  // namespace

std::string resolved(const Options& options) {
  std::string xml = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
  write(options, "", xml);
  return xml;
}

}  // namespace culm::deck
