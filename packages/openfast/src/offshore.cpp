#include "offshore.hpp"

#include <culm/openfast/hydrodyn.hpp>
#include <culm/openfast/moordyn.hpp>
#include <culm/openfast/seastate.hpp>
#include <culm/openfast/subdyn.hpp>

#include "headings.hpp"
#include "hydrodyn_deck.hpp"
#include "moordyn_deck.hpp"
#include "sea_lists.hpp"
#include "subdyn_deck.hpp"

namespace culm::openfast {

std::optional<std::string> import_offshore(const InputFile& file, Report& report) {
  if (file.has("NReact") || file.has("NInterf")) {
    return write_deck(read_subdyn(file.path(), report), report);
  }
  if (file.has("NAxCoef")) return write_deck(read_hydrodyn(file.path(), report), report);
  if (file.has("WaveMod")) {
    return write_deck(read_seastate(file.path(), find_surroundings(file.path()), report), report);
  }
  if (file.has_heading("LINE TYPES") || file.has_heading("LINE DICTIONARY")) {
    return write_deck(read_moordyn(file.path(), report), report);
  }
  return {};
}

}  // namespace culm::openfast
