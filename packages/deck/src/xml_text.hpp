#pragma once

#include <string>
#include <string_view>

namespace culm::deck {

/// Why a text cannot stand in XML 1.0: "is no valid UTF-8" or "has a character that XML does not
/// allow"; empty if it can. What the parser of XML has read always can.
std::string xml_objection(std::string_view text);

/// The text for a message: other bytes than printable ASCII as \xNN, and cut if it is long.
std::string printable(std::string_view text);

/// The text as it stands between the quotes of an attribute, or between tags.
std::string escaped(std::string_view text);

}  // namespace culm::deck
