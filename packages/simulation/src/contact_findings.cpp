#include "contact_findings.hpp"

#include <culm/contact/contact_point.hpp>

namespace culm::simulation {

std::vector<std::string> deep_contacts(const model::Model& model, const model::Coordinates& q) {
  std::vector<std::string> sentences;
  for (const auto& load : model.loads()) {
    const auto* contact = dynamic_cast<const contact::Contact*>(load.get());
    if (contact == nullptr) continue;
    const std::string objection = contact->objection(q);
    if (objection.empty()) continue;
    sentences.push_back("what " + load->effect().quoted() + " should keep out " + objection +
                        ": contact drives it out with energy that nothing has put in");
  }
  return sentences;
}

std::vector<std::string> contacts_at_rest(const model::Model& model) {
  std::vector<std::string> sentences;
  for (const auto& load : model.loads()) {
    const auto* contact = dynamic_cast<const contact::Contact*>(load.get());
    if (contact == nullptr || contact->left_out_at_rest().empty()) continue;
    sentences.push_back(load->effect().quoted() + " " + contact->left_out_at_rest());
  }
  return sentences;
}

}  // namespace culm::simulation
