#include "xml_text.hpp"

#include <libxml/chvalid.h>
#include <libxml/xmlstring.h>

namespace culm::deck {

std::string xml_objection(std::string_view text) {
  const std::string ended(text);
  const auto* rest = reinterpret_cast<const unsigned char*>(ended.c_str());
  if (ended.size() != text.size() || xmlCheckUTF8(rest) == 0) return "is no valid UTF-8";
  auto left = static_cast<int>(ended.size());
  while (left > 0) {
    int length = left;
    const int character = xmlGetUTF8Char(rest, &length);
    if (character < 0) return "is no valid UTF-8";
    if (!xmlIsCharQ(character)) return "has a character that XML does not allow";
    rest += length;
    left -= length;
  }
  return {};
}

std::string printable(std::string_view text) {
  constexpr std::size_t most = 60;
  constexpr std::string_view digits = "0123456789abcdef";
  std::string shown;
  for (const char symbol : text) {
    if (shown.size() >= most) return shown + "…";
    const auto byte = static_cast<unsigned char>(symbol);
    if (byte >= 0x20 && byte < 0x7f) {
      shown += symbol;
    } else {
      shown += {'\\', 'x', digits[byte / 16U], digits[byte % 16U]};
    }
  }
  return shown;
}

std::string escaped(std::string_view text) {
  std::string result;
  for (const char symbol : text) {
    switch (symbol) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      // XML turns white space of attributes into blanks, unless it is written by number.
      case '\n':
        result += "&#10;";
        break;
      case '\t':
        result += "&#9;";
        break;
      case '\r':
        result += "&#13;";
        break;
      default:
        result += symbol;
    }
  }
  return result;
}

}  // namespace culm::deck
