#include <culm/model/effect.hpp>

#include <utility>

namespace culm::model {

Effect::Effect(std::string of_type, std::string of_name, std::string of_part)
    : type(std::move(of_type)), name(std::move(of_name)), part(std::move(of_part)) {}

Effect::Effect(const char* of_type) : type(of_type) {}

Effect Effect::of_part(std::string other) const { return {type, name, std::move(other)}; }

std::string Effect::title() const {
  std::string text = type;
  for (const std::string* more : {&name, &part}) {
    if (!more->empty()) text += ", " + *more;
  }
  return text;
}

std::string Effect::quoted() const { return name.empty() ? type : type + " '" + name + "'"; }

}  // namespace culm::model
