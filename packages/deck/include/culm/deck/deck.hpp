#pragma once

#include <culm/base/issue.hpp>
#include <culm/base/options.hpp>
#include <culm/base/schema.hpp>

#include <memory>
#include <string>
#include <vector>

namespace culm::deck {

struct RawList;

/// A file by its name and its content. Names of included files are relative to nothing: they are
/// what the including file's name and `href` give together.
struct DeckText {
  std::string name;
  std::string text;
  std::string objection = {};  ///< why an included file cannot be read; empty if it can
};

/// Assignments from the command line, "Structures/beam/Curve/Elements=32". They replace the text of
/// a value, whose unit and type stay, or of a <Variable>; what is missing is created.
using Overrides = std::vector<std::string>;

/// An input deck as it was read: well-formed, with its includes, not yet checked against a schema.
/// Mistakes that leave the deck readable wait for validate(), so that a user sees them all at once.
class Deck {
 public:
  /// Reads a file and what it includes. Throws FileError if the file cannot be read, InputError
  /// if it is no XML, UsageError if an override is no assignment, or no text that XML can hold.
  static Deck parse_file(const std::string& path, const Overrides& overrides = {});

  /// Reads a text; `name` stands for the file in messages and is where includes are relative to.
  static Deck parse_text(std::string text, std::string name, const Overrides& overrides = {});

  /// The file and all that it includes, so that one rank reads and all ranks parse the same.
  /// Includes that cannot be read have an objection, which parse_texts reports. Throws FileError if
  /// the file itself cannot be read.
  static std::vector<DeckText> read_files(const std::string& path);

  /// Parses the first text; the others serve its includes, and no file is opened.
  static Deck parse_texts(const std::vector<DeckText>& texts, const Overrides& overrides = {});

  /// Checks the deck, resolves variables, expressions and units, and fills in defaults. Throws
  /// InputError with all mistakes, each with file, line, path, rule and the value found.
  Options validate(const Schema& root) const;

  /// Name of the file.
  const std::string& name() const { return name_; }

 private:
  Deck(std::string name, RawList root, InputIssues issues);

  std::string name_;
  std::shared_ptr<const RawList> root_;
  InputIssues issues_;
};

}  // namespace culm::deck
