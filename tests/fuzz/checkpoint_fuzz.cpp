// A checkpoint: the file, and what stands behind its checksum.

#include <culm/base/snapshot.hpp>
#include <culm/output/checkpoint_file.hpp>
#include <culm/simulation/read_deck.hpp>

#include "fuzz_target.hpp"

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  using namespace culm;
  const std::string_view bytes = fuzz::text_of(data, size);
  const auto path = fuzz::write_scratch("run.checkpoint", bytes);
  fuzz::survive([&] { (void)output::read_checkpoint(path); });
  fuzz::survive([&] {
    const Snapshot snapshot = Snapshot::decode(bytes);
    const auto source = simulation::DeckSource::restore(snapshot);
    (void)deck::Deck::parse_texts(source.texts, source.overrides);
  });
  return 0;
}
