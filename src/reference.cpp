#include <culm/deck/reference.hpp>
#include <culm/simulation/catalogue.hpp>

#include "command.hpp"

#include <cstdio>

namespace culm::app {

void reference(const parallel::Comm& comm, const std::string& name) {
  const std::string text = deck::reference(simulation::Catalogue().deck_schema(), name);
  if (comm.is_root()) std::fputs(text.c_str(), stdout);
}

}  // namespace culm::app
