/// The signal that asks this process to end before its time.
#pragma once

#include <optional>

namespace culm {

/// Keeps a signal, by its number, with the time at which it came; 0 forgets it. May be called in a
/// signal handler.
void note_stop_signal(int number) noexcept;

/// Number of the signal that came last; 0 if none.
int stop_signal() noexcept;

/// Time since then [s]; none without a signal.
std::optional<double> since_stop_signal() noexcept;

/// Throws Stopped where a signal came more than `grace` ago [s].
/// @param what  what the process did meanwhile, such as "while nobody came"
void stop_if_asked(double grace, const char* what);

}  // namespace culm
