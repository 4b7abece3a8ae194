#include "contact_findings.hpp"

#include <culm/contact/contact_point.hpp>

#include <algorithm>

namespace culm::simulation {
namespace {

const contact::Contact* as_contact(const model::Batch& load) {
  return dynamic_cast<const contact::Contact*>(&load);
}

/// A sentence for each contact of which `find` finds something to say.
template <class Find, class Say>
std::vector<std::string> sentences_of(const model::Model& model, Find find, Say say) {
  std::vector<std::string> sentences;
  for (const auto& load : model.loads()) {
    const contact::Contact* contact = as_contact(*load);
    if (contact == nullptr) continue;
    const std::string found = find(*contact);
    if (!found.empty()) sentences.push_back(say(load->effect().quoted(), found));
  }
  return sentences;
}

std::string name_first(const std::string& name, const std::string& found) {
  return name + " " + found;
}

}  // namespace

bool has_contacts(const model::Model& model) {
  return std::ranges::any_of(model.loads(),
                             [](const auto& load) { return as_contact(*load) != nullptr; });
}

std::vector<std::string> deep_contacts(const model::Model& model, const model::Coordinates& q) {
  return sentences_of(
      model, [&](const contact::Contact& contact) { return contact.objection(q); },
      [](const std::string& name, const std::string& found) {
        return "what " + name + " should keep out " + found +
               ": contact drives it out with energy that nothing has put in";
      });
}

std::vector<std::string> coarse_contacts(const model::Model& model, const model::Coordinates& q) {
  return sentences_of(
      model, [&](const contact::Contact& contact) { return contact.overlooked(q); }, name_first);
}

std::vector<std::string> contacts_at_rest(const model::Model& model) {
  return sentences_of(
      model, [](const contact::Contact& contact) { return contact.left_out_at_rest(); },
      name_first);
}

}  // namespace culm::simulation
