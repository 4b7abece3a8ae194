#include <culm/deck/deck.hpp>
#include <culm/simulation/read_deck.hpp>

namespace culm::simulation {
namespace {

// The texts of the root on all ranks; its error, if it has one, too.
std::vector<deck::DeckText> read_on_root(const parallel::Comm& comm, const std::string& path) {
  std::vector<deck::DeckText> texts;
  std::string error;
  if (comm.is_root()) {
    try {
      texts = deck::Deck::read_files(path);
    } catch (const FileError& e) {
      error = e.what();
    }
  }
  error = comm.broadcast(error);
  if (!error.empty()) throw FileError(error);
  const int count = comm.max(static_cast<int>(texts.size()));
  texts.resize(static_cast<std::size_t>(count));
  for (deck::DeckText& text : texts) {
    text.name = comm.broadcast(text.name);
    text.text = comm.broadcast(text.text);
  }
  return texts;
}

}  // namespace

Options read_deck(const parallel::Comm& comm, const Catalogue& catalogue, const std::string& path,
                  const std::vector<std::string>& overrides) {
  const auto texts = read_on_root(comm, path);
  return deck::Deck::parse_texts(texts, overrides).validate(catalogue.deck_schema());
}

}  // namespace culm::simulation
