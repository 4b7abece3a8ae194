#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace culm::deck {

/// Limits of one deck with all that it includes.
inline constexpr int max_depth = 64;
inline constexpr std::size_t max_bytes = std::size_t{64} << 20U;

struct XmlAttribute {
  std::string name;
  std::string value;
};

/// An element of an XML file. `line` is where its tag begins.
struct XmlElement {
  std::string name;
  int line = 0;
  std::vector<XmlAttribute> attributes;
  std::vector<XmlElement> children;
  std::string stray_text;  ///< the first text between tags; a deck has none
  int stray_line = 0;
};

/// Reads a whole XML file. Never opens another file or the network and knows no document types,
/// hence no entities but the five of XML. XInclude elements are named "xi:include" whatever their
/// prefix. Throws InputError with one issue if the text is not well-formed.
XmlElement read_xml(const std::string& text, const std::string& file);

}  // namespace culm::deck
