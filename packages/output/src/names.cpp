#include "names.hpp"

#include <fmt/core.h>

namespace culm::output {

namespace {

bool is_control(char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }

bool is_plain(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
}

}  // namespace

std::string link_name(std::string_view name) {
  constexpr std::string_view special = "/:%|";
  // "." is the group itself, so names of dots only would not make a link.
  const bool dots = name.find_first_not_of('.') == std::string_view::npos;
  std::string link;
  for (const char c : name) {
    if (dots || is_control(c) || special.find(c) != std::string_view::npos) {
      link += fmt::format("%{:02X}", static_cast<unsigned>(static_cast<unsigned char>(c)));
    } else {
      link += c;
    }
  }
  return link.empty() ? "%" : link;
}

std::string file_part(std::string_view name) {
  std::string part;
  for (const char c : name) {
    const char lower = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    part += is_plain(c) ? lower : '_';
  }
  return part;
}

std::string xml_escape(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      // Other control characters cannot be written in XML 1.0 at all.
      default:
        escaped += is_control(c) ? ' ' : c;
    }
  }
  return escaped;
}

std::string step_name(int index) { return fmt::format("{:06}", index); }

}  // namespace culm::output
