/// Headings of the report of an import.
#pragma once

namespace culm::openfast {

inline constexpr const char* read = "read";
inline constexpr const char* conventions = "conventions";
inline constexpr const char* assumed = "assumed";
inline constexpr const char* missing = "not in these files, and what that does";
inline constexpr const char* checked = "checked";
inline constexpr const char* masses = "masses";
inline constexpr const char* frequencies = "first frequencies";
inline constexpr const char* not_used = "not used";
inline constexpr const char* unknown = "unknown or contradictory";

}  // namespace culm::openfast
