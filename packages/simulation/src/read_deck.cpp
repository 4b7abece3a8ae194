#include <culm/base/error.hpp>
#include <culm/simulation/read_deck.hpp>

#include "on_root.hpp"

#include <filesystem>
#include <string>
#include <utility>

namespace culm::simulation {

DeckSource read_source(const parallel::Comm& comm, const std::string& path,
                       std::vector<std::string> overrides) {
  DeckSource source{{}, std::move(overrides)};
  on_root(comm, [&] { source.texts = deck::Deck::read_files(path); });
  const int count = comm.max(static_cast<int>(source.texts.size()));
  source.texts.resize(static_cast<std::size_t>(count));
  for (deck::DeckText& text : source.texts) {
    text.name = comm.broadcast(text.name);
    text.text = comm.broadcast(text.text);
    text.objection = comm.broadcast(text.objection);
  }
  return source;
}

Options read_deck(const Catalogue& catalogue, const DeckSource& source) {
  return deck::Deck::parse_texts(source.texts, source.overrides).validate(catalogue.deck_schema());
}

void DeckSource::save(Snapshot& snapshot) const {
  snapshot.set("deck/files", static_cast<double>(texts.size()));
  for (std::size_t i = 0; i < texts.size(); ++i) {
    const std::string number = std::to_string(i);
    // from another folder the deck still finds its tables
    snapshot.set_text("deck/name " + number, std::filesystem::absolute(texts[i].name).string());
    snapshot.set_text("deck/text " + number, texts[i].text);
  }
  snapshot.set("deck/overrides", static_cast<double>(overrides.size()));
  for (std::size_t i = 0; i < overrides.size(); ++i) {
    snapshot.set_text("deck/override " + std::to_string(i), overrides[i]);
  }
}

DeckSource DeckSource::restore(const Snapshot& snapshot) {
  const auto count = [&](const std::string& name, int least) {
    const int found = snapshot.integer(name);
    if (found >= least) return found;
    throw FileError("the checkpoint has " + std::to_string(found) + " for '" + name +
                    "', which is at least " + std::to_string(least));
  };
  DeckSource source;
  for (int i = 0; i < count("deck/files", 1); ++i) {
    const std::string number = std::to_string(i);
    source.texts.push_back(
        {snapshot.text("deck/name " + number), snapshot.text("deck/text " + number), {}});
  }
  for (int i = 0; i < count("deck/overrides", 0); ++i) {
    source.overrides.push_back(snapshot.text("deck/override " + std::to_string(i)));
  }
  return source;
}

}  // namespace culm::simulation
