#include <culm/base/text.hpp>
#include <culm/openfast/deck_writer.hpp>

#include "degree.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace culm::openfast {

namespace {

std::string escape(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    if (c == '&') {
      safe += "&amp;";
    } else if (c == '<') {
      safe += "&lt;";
    } else if (c == '"') {
      safe += "&quot;";
    } else {
      safe += c;
    }
  }
  return safe;
}

constexpr std::size_t per_line = 6;

// Two dashes would end a comment of XML.
std::string safe_comment(std::string text) {
  for (std::size_t at = text.find("--"); at != std::string::npos; at = text.find("--", at)) {
    text.replace(at, 2, "- ");
  }
  return text;
}

// Twelve digits, which hides the round-off of what was computed; no sign at a zero.
std::string format(double value) { return fmt::format("{:.12g}", value == 0.0 ? 0.0 : value); }

}  // namespace

DeckWriter::DeckWriter(const std::string& title, const std::vector<std::string>& about) {
  depth_ = 0;
  comment(about);
  text_ += "<ParameterList name=\"culm\">\n";
  depth_ = 1;
  set("Title", title);
}

void DeckWriter::line(const std::string& content) {
  text_ += std::string(static_cast<std::size_t>(2 * depth_), ' ') + content + "\n";
}

void DeckWriter::open(const std::string& list) {
  if (depth_ == 1) text_ += "\n";
  line(fmt::format("<ParameterList name=\"{}\">", escape(list)));
  ++depth_;
}

void DeckWriter::open(const std::string& list, const std::string& type) {
  open(list);
  set("Type", type);
}

void DeckWriter::close() {
  --depth_;
  line("</ParameterList>");
}

void DeckWriter::set(const std::string& name, const std::string& value) {
  line(fmt::format("<Parameter name=\"{}\" value=\"{}\"/>", escape(name), escape(value)));
}

void DeckWriter::set(const std::string& name, double value) { set(name, format(value)); }

void DeckWriter::set_degrees(const std::string& name, const std::vector<double>& radians) {
  std::vector<std::string> items;
  for (const double angle : radians) items.push_back(format(angle / degree));
  set_items(name, items, per_line, "deg");
}

void DeckWriter::set_triangle(const std::string& name, const Mat6& matrix) {
  line(fmt::format("<Parameter name=\"{}\" value=\"{{", escape(name)));
  for (int i = 0; i < 6; ++i) {
    std::string row(static_cast<std::size_t>(2 + 13 * i), ' ');
    for (int j = i; j < 6; ++j) {
      row += j < 5 ? fmt::format("{:<13}", format(matrix(i, j)) + ", ") : format(matrix(i, j));
    }
    line(row + (i < 5 ? "," : "}\"/>"));
  }
}

void DeckWriter::set(const std::string& name, int value) { set(name, std::to_string(value)); }

void DeckWriter::set(const std::string& name, const Vec3& value) {
  set(name, std::vector<double>(value.data(), value.data() + 3));
}

void DeckWriter::set_items(const std::string& name, const std::vector<std::string>& items,
                           std::size_t per_line, const std::string& unit) {
  const std::string end_tag = unit.empty() ? "/>" : fmt::format(" unit=\"{}\"/>", unit);
  if (items.size() <= per_line) {
    line(fmt::format("<Parameter name=\"{}\" value=\"{{{}}}\"{}", escape(name),
                     escape(join(items, ", ")), end_tag));
    return;
  }
  line(fmt::format("<Parameter name=\"{}\" value=\"{{", escape(name)));
  for (std::size_t at = 0; at < items.size(); at += per_line) {
    const std::size_t end = std::min(at + per_line, items.size());
    const auto first = items.begin() + static_cast<std::ptrdiff_t>(at);
    const auto last = items.begin() + static_cast<std::ptrdiff_t>(end);
    line("  " + escape(join({first, last}, ", ")) + (end < items.size() ? "," : "}\"" + end_tag));
  }
}

void DeckWriter::set(const std::string& name, const std::vector<double>& values) {
  std::vector<std::string> items;
  for (const double value : values) items.push_back(format(value));
  set_items(name, items, per_line);
}

void DeckWriter::set(const std::string& name, const std::vector<std::string>& values) {
  set_items(name, values, per_line);
}

void DeckWriter::variable(const std::string& name, double value, const std::string& comment,
                          const std::string& unit) {
  line(fmt::format("<Variable name=\"{}\" value=\"{}\"{}/>  <!-- {} -->", escape(name),
                   format(value), unit.empty() ? "" : fmt::format(" unit=\"{}\"", unit),
                   safe_comment(comment)));
}

void DeckWriter::comment(const std::vector<std::string>& lines) {
  for (std::size_t i = 0; i < lines.size(); ++i) {
    line((i == 0 ? "<!-- " : "     ") + safe_comment(lines[i]) +
         (i + 1 == lines.size() ? " -->" : ""));
  }
}

std::string DeckWriter::text() const { return text_ + "</ParameterList>\n"; }

std::string name_from(const std::filesystem::path& folder, const std::filesystem::path& file) {
  const auto base = std::filesystem::absolute(folder.empty() ? "." : folder);
  return std::filesystem::absolute(file).lexically_proximate(base.lexically_normal()).string();
}

}  // namespace culm::openfast
