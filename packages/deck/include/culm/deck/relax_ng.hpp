#pragma once

#include <culm/base/schema.hpp>

#include <string>

namespace culm::deck {

/// The schema as a grammar in RELAX NG (XML syntax, ISO/IEC 19757-2), for editors and validators:
/// which names, types, lists, attributes and kinds of values may stand where, with the sentences of
/// the reference. It accepts every sound deck, and each list of the top by itself, as files that
/// are included have it. What it cannot say: that something is missing or stands there twice
/// (patterns of elements of one name may not be interleaved), what expressions amount to, rules
/// across parameters.
std::string relax_ng(const Schema& root);

}  // namespace culm::deck
