/// Text of a deck, list by list.
#pragma once

#include <culm/math/types.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace culm::openfast {

/// Writes nested lists with their parameters and comments, indented as the decks in inputs/ are.
/// Numbers have
/// twelve digits.
class DeckWriter {
 public:
  /// @param about  comment at the top
  DeckWriter(const std::string& title, const std::vector<std::string>& about);

  void open(const std::string& list);
  void close();
  /// A list whose entries are of types: opens it and states the type.
  void open(const std::string& list, const std::string& type);

  void set(const std::string& name, const std::string& value);
  void set(const std::string& name, const char* value) { set(name, std::string(value)); }
  void set(const std::string& name, double value);
  void set(const std::string& name, int value);
  void set(const std::string& name, const Vec3& value);
  /// An array, six items in each line.
  void set(const std::string& name, const std::vector<double>& values);
  void set(const std::string& name, const std::vector<std::string>& values);
  /// Angles, written in degrees.
  void set_degrees(const std::string& name, const std::vector<double>& radians);
  /// The 21 values of the upper triangle, row below row.
  void set_triangle(const std::string& name, const Mat6& matrix);
  void variable(const std::string& name, double value, const std::string& comment,
                const std::string& unit = {});
  /// Lines of one comment.
  void comment(const std::vector<std::string>& lines);

  /// The whole deck. @pre all lists that were opened are closed
  std::string text() const;

 private:
  void line(const std::string& content);
  void set_items(const std::string& name, const std::vector<std::string>& items,
                 std::size_t per_line, const std::string& unit = {});

  int depth_ = 1;
  std::string text_;
};

/// The name of a file as a deck in a folder gives it.
std::string name_from(const std::filesystem::path& folder, const std::filesystem::path& file);

}  // namespace culm::openfast
