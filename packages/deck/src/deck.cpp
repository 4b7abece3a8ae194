#include <culm/base/error.hpp>
#include <culm/base/read_file.hpp>
#include <culm/base/text.hpp>
#include <culm/deck/deck.hpp>

#include "raw_list.hpp"
#include "teuchos_gate.hpp"
#include "validator.hpp"
#include "xml_reader.hpp"

#include <unordered_map>
#include <utility>

namespace culm::deck {
namespace {

std::string read_first_text(const std::string& path) {
  std::string text = read_file(path, max_bytes);
  if (trim(text).empty()) throw FileError(path, "the file is empty");
  return text;
}

FileText read_included(const std::string& path) { return find_text(path, max_bytes); }

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
  RawList root = read_raw(text, name, read_included, issues);
  apply_overrides(overrides, root);
  return {std::move(name), std::move(root), std::move(issues)};
}

std::vector<DeckText> Deck::read_files(const std::string& path) {
  std::vector<DeckText> texts = {{path, read_first_text(path)}};
  std::unordered_map<std::string, FileText> known = {{path, {texts.front().text}}};
  const auto record = [&](const std::string& file) {
    const auto [found, is_new] = known.try_emplace(file);
    if (is_new) {
      found->second = read_included(file);
      texts.push_back({file, found->second.text, found->second.objection});
    }
    return found->second;
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
  std::unordered_map<std::string, const DeckText*> by_name;
  for (const DeckText& text : texts) by_name.emplace(text.name, &text);
  const auto find = [&](const std::string& file) -> FileText {
    const auto found = by_name.find(file);
    if (found == by_name.end()) return {{}, "it is not part of this deck"};
    return {found->second->text, found->second->objection};
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
