/// What a batch is: the identity of an effect, apart from how it is shown.
#pragma once

#include <compare>
#include <string>

namespace culm::model {

/// Type and entry of the deck that a batch belongs to. States, memories and checkpoints refer to
/// these; people read `title`.
struct Effect {
  std::string type;       ///< "Force", or "Beam, director, order 2"
  std::string name = {};  ///< of the entry of the deck; empty where a batch serves several
  std::string part = {};  ///< where an entry has several batches, such as "moments"

  Effect(std::string of_type, std::string of_name = {}, std::string of_part = {});
  Effect(const char* of_type);

  /// Another batch of the same entry.
  Effect of_part(std::string other) const;

  auto operator<=>(const Effect&) const = default;
  bool operator==(const Effect&) const = default;

  /// In the ledger and in messages: "Force, tip force".
  std::string title() const;
  /// "Force 'tip force'", in sentences.
  std::string quoted() const;
};

}  // namespace culm::model
