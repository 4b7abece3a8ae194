#pragma once

namespace culm::deck {

/// Version of the format of decks: one more with each change after which some sound deck is wrong
/// or means something else. CHANGELOG.md says what changed.
inline constexpr int format_version = 1;

}  // namespace culm::deck
