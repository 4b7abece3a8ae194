/* An added mass that leads culm, over a socket or MPI: its answer to a step acts in the next one.
   usage: leading_mass ADDRESS | leading_mass mpi
   On its way it makes detours that leave no trace: loads that are too large, steps that it goes back on. */
#include "culm_partner.h"

#define MASS 0.1

typedef struct {
  double velocity[64], loads[128];
} mass_state;

static int step(culm_partner* it, mass_state* now) {
  const double h = it->proposal - it->time;
  culm_window window;
  if (culm_structure_attempt(it, it->proposal, now->loads, &window) != 1) return -1;
  for (uint32_t i = 0; i < 3 * it->points; ++i) {
    const uint32_t k = 6 * (i / 3) + i % 3;
    now->loads[k] = -2.0 * MASS / h * (window.motion[k] / h - now->velocity[i]);
    now->velocity[i] = 2.0 / h * window.motion[k] - now->velocity[i];
  }
  return culm_structure_accept(it);
}

static int detour(culm_partner* it, const mass_state* now) {
  mass_state there = *now;
  culm_window window;
  if (culm_structure_save(it, 7)) return -1;
  for (uint32_t i = 0; i < 6 * it->points; ++i) there.loads[i] *= 1000.0;
  if (culm_structure_attempt(it, it->time + 0.001, there.loads, &window) < 0) return -1;
  if (culm_structure_discard(it)) return -1;
  for (int i = 0; i < 12; ++i) {
    if (step(it, &there)) return -1;
  }
  return culm_structure_restore(it, 7);
}

static int lead(culm_partner* it) {
  mass_state now;
  memset(&now, 0, sizeof now);
  if (culm_structure_begin(it, "mass", CULM_MOTION)) return -1;
  if (it->points > 20) return culm_partner_fail(it, "there are too many points");
  for (uint32_t i = 0; i < 3 * it->points; ++i) now.velocity[i] = it->velocity[6 * (i / 3) + i % 3];
  for (int steps = 0; it->proposal > it->time; ++steps) {
    if (steps == 30 && detour(it, &now)) return -1;
    if (step(it, &now)) return -1;
  }
  return culm_structure_end(it);
}

int main(int argc, char** argv) {
  culm_partner it;
  int failed;
  if (argc != 2) return 2;
#ifdef CULM_PARTNER_MPI
  MPI_Init(&argc, &argv);
  failed = culm_partner_open_mpi(&it, MPI_COMM_WORLD, 0);
#else
  failed = culm_partner_open(&it, argv[1], 20.0);
#endif
  if (!failed) failed = lead(&it);
  if (failed) fprintf(stderr, "%s\n", it.error);
  culm_partner_close(&it);
#ifdef CULM_PARTNER_MPI
  MPI_Finalize();
#endif
  return failed != 0;
}
