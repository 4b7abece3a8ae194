#include <culm/base/error.hpp>
#include <culm/base/text.hpp>
#include <culm/deck/deck.hpp>

#include "raw_list.hpp"
#include "teuchos_gate.hpp"
#include "validator.hpp"
#include "xml_reader.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <optional>
#include <utility>

namespace culm::deck {
namespace {

/// The content of a file; one byte more than allowed at most, which the reader of XML refuses.
std::optional<std::string> read_text(const std::string& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) return std::nullopt;
  std::ifstream file(path, std::ios::binary);
  if (!file) return std::nullopt;
  std::string text;
  std::string block(std::size_t{1} << 16U, '\0');
  while (text.size() <= max_bytes) {
    file.read(block.data(), static_cast<std::streamsize>(block.size()));
    text.append(block, 0, static_cast<std::size_t>(file.gcount()));
    if (!file) break;
  }
  if (file.bad()) return std::nullopt;
  return text;
}

std::string read_first_text(const std::string& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) throw FileError(path, "is a directory");
  if (!std::filesystem::exists(path, ignored)) throw FileError(path, "there is no such file");
  std::optional<std::string> text = read_text(path);
  if (!text) throw FileError(path, "cannot be read");
  if (trim(*text).empty()) throw FileError(path, "the file is empty");
  return std::move(*text);
}

}  // namespace

Deck::Deck(std::string name, RawList root, InputIssues issues)
    : name_(std::move(name)),
      root_(std::make_shared<const RawList>(std::move(root))),
      issues_(std::move(issues)) {}

Deck Deck::parse_file(const std::string& path, const Overrides& overrides) {
  return parse_text(read_first_text(path), path, overrides);
}

Deck Deck::parse_text(std::string text, std::string name, const Overrides& overrides) {
  InputIssues issues;
  RawList root = read_raw(text, name, read_text, issues);
  apply_overrides(overrides, root);
  return {std::move(name), std::move(root), std::move(issues)};
}

std::vector<DeckText> Deck::read_files(const std::string& path) {
  std::vector<DeckText> texts = {{path, read_first_text(path)}};
  const auto record = [&](const std::string& file) {
    const auto known = std::ranges::find(texts, file, &DeckText::name);
    if (known != texts.end()) return std::optional(known->text);
    std::optional<std::string> text = read_text(file);
    if (text) texts.push_back({file, *text});
    return text;
  };
  try {
    InputIssues issues;
    const std::string first = texts.front().text;
    read_raw(first, path, record, issues);
  } catch (const InputError&) {
    // Whoever parses the texts meets the same mistake and reports it.
  }
  return texts;
}

Deck Deck::parse_texts(const std::vector<DeckText>& texts, const Overrides& overrides) {
  internal_check(!texts.empty(), "a deck has at least one text");
  const auto find = [&](const std::string& file) -> std::optional<std::string> {
    const auto found = std::ranges::find(texts, file, &DeckText::name);
    return found == texts.end() ? std::nullopt : std::optional(found->text);
  };
  InputIssues issues;
  RawList root = read_raw(texts.front().text, texts.front().name, find, issues);
  apply_overrides(overrides, root);
  return {texts.front().name, std::move(root), std::move(issues)};
}

Options Deck::validate(const Schema& root) const {
  InputIssues issues = issues_;
  Options options = Validator(issues).root(*root_, root);
  issues.throw_if_any();
  const std::string objection = teuchos_objection(options, root);
  internal_check(objection.empty(), "Teuchos does not accept a deck that culm does: " + objection);
  return options;
}

}  // namespace culm::deck
