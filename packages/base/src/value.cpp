#include <culm/base/text.hpp>
#include <culm/base/value.hpp>

#include <array>

namespace culm {
namespace {

std::string item_text(double value) { return format_number(value); }
std::string item_text(int value) { return std::to_string(value); }
std::string item_text(bool value) { return value ? "true" : "false"; }
std::string item_text(const std::string& value) { return value; }

template <class Item>
std::string item_text(const std::vector<Item>& items) {
  std::vector<std::string> texts;
  texts.reserve(items.size());
  for (const Item& item : items) texts.push_back(item_text(item));
  return "{" + join(texts, ", ") + "}";
}

}  // namespace

std::string to_string(Kind kind) {
  static constexpr std::array names = {"number",  "integer",  "flag", "text",
                                       "numbers", "integers", "texts"};
  return names.at(static_cast<std::size_t>(kind));
}

std::string to_string(const Value& value) {
  return std::visit([](const auto& content) { return item_text(content); }, value);
}

}  // namespace culm
