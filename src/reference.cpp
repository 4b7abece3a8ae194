#include <culm/deck/reference.hpp>
#include <culm/deck/relax_ng.hpp>
#include <culm/simulation/catalogue.hpp>

#include "command.hpp"

#include <cstdio>

namespace culm::app {

void reference(const parallel::Comm& comm, const ReferenceArguments& arguments) {
  const Schema schema = simulation::Catalogue().deck_schema();
  const std::string text =
      arguments.relax_ng ? deck::relax_ng(schema) : deck::reference(schema, arguments.name);
  if (comm.is_root()) std::fputs(text.c_str(), stdout);
}

}  // namespace culm::app
