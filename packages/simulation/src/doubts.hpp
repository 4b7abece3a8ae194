/// What is doubtful about a deck before its steps are made.
#pragma once

#include <culm/base/findings.hpp>
#include <culm/base/log.hpp>
#include <culm/base/options.hpp>
#include <culm/model/model.hpp>

namespace culm::simulation {

/// Tells what is doubtful whatever analysis is taken up.
void tell_of_deck(const Options& deck, Findings& findings, const Log& log);

/// Warns of what an analysis of the deck leaves out, or finds that does not fit together, as it
/// begins from a state.
void warn_before(const Options& deck, const Options& analysis, const model::Model& model,
                 const model::State& state, Findings& findings);

/// Warns where ports show a program or partner other velocities and accelerations in open steps
/// than the scheme of an analysis has.
void warn_of_rates(const Options& analysis, const model::State& state, Findings& findings);

}  // namespace culm::simulation
