/* The added mass of inputs/coupling/partners.xml as a program of its own, over a socket or MPI.
   usage: mass_partner ADDRESS | mass_partner mpi */
#include "culm_partner.h"

#include <math.h>

#define MASS 20.0

static double kinetic(const double* velocity, uint32_t n) {
  double sum = 0.0;
  for (uint32_t i = 0; i < 3 * n; ++i) sum += velocity[i] * velocity[i];
  return 0.5 * MASS * sum;
}

static int serve(culm_partner* it) {
  if (culm_partner_begin(it, "mass", CULM_MOTION, INFINITY)) return -1;
  const uint32_t n = it->points;
  double* velocity = malloc(3 * n * sizeof(double));
  double* loads = calloc(6 * n, sizeof(double));
  for (uint32_t i = 0; i < 3 * n; ++i) velocity[i] = it->velocity[6 * (i / 3) + i % 3];
  const double start = kinetic(velocity, n);
  culm_window window;
  int kind, failed = 0;
  while (!failed && (kind = culm_partner_next(it, &window)) > 0) {
    const double h = window.end - window.start;
    if (kind == CULM_SAVE) failed = culm_partner_saved(it);
    for (uint32_t i = 0; i < 3 * n && kind != CULM_SAVE; ++i) {
      const uint32_t k = 6 * (i / 3) + i % 3;
      if (kind == CULM_ATTEMPT) loads[k] = -2.0 * MASS / h * (window.motion[k] / h - velocity[i]);
      if (kind == CULM_ACCEPT) velocity[i] = 2.0 / h * window.motion[k] - velocity[i];
    }
    if (kind == CULM_ATTEMPT) failed = culm_partner_answer(it, loads);
    if (kind == CULM_ACCEPT) failed = culm_partner_accepted(it, kinetic(velocity, n) - start, 0.0);
  }
  free(velocity);
  free(loads);
  return failed || kind < 0 ? -1 : 0;
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
  if (!failed) failed = serve(&it);
  if (failed) fprintf(stderr, "%s\n", it.error);
  culm_partner_close(&it);
#ifdef CULM_PARTNER_MPI
  MPI_Finalize();
#endif
  return failed != 0;
}
