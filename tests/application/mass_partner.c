/* The added mass of inputs/coupling/partners.xml as a program of its own, over a socket or MPI.
   usage: mass_partner ADDRESS [WAY] | mass_partner mpi [WAY]
   WAY: how it fails in the second attempt of the sixth window, or what it lies about its energy from there on; 'forget' is
   'kill' of one that keeps nothing, 'anew' begins at rest where culm goes on. */
#include "culm_partner.h"

#include <math.h>
#include <signal.h>

#define MASS 20.0

static double kinetic(const double* velocity, uint32_t n) {
  double sum = 0.0;
  for (uint32_t i = 0; i < 3 * n; ++i) sum += velocity[i] * velocity[i];
  return 0.5 * MASS * sum;
}

/* Velocities and the energy at the start, in a file of the present folder. */
static int keep(const char* mode, uint32_t window, double* velocity, uint32_t n, double* start) {
  char name[64];
  FILE* file;
  size_t done;
  snprintf(name, sizeof name, "mass%u.bin", window);
  if ((file = fopen(name, mode)) == NULL) return -1;
  done = *mode == 'w' ? fwrite(velocity, sizeof(double), 3 * n, file) + fwrite(start, sizeof(double), 1, file)
                      : fread(velocity, sizeof(double), 3 * n, file) + fread(start, sizeof(double), 1, file);
  return fclose(file) == 0 && done == 3 * n + 1 ? 0 : -1;
}

static void wait_for_ever(void) {
  for (;;) sleep(1);
}

/* Returns 0 where the answer goes out as usual. */
static int fail_in(const char* way, culm_partner* it, double* loads) {
  const size_t size = 48 * (size_t)it->points;
  const uint32_t number = 0;
  const struct timespec pause = {0, 200000000};
  char* frame;
  if (strcmp(way, "kill") == 0 || strcmp(way, "forget") == 0) raise(SIGKILL);
  if (strcmp(way, "leave") == 0) _exit(0);
  if (strcmp(way, "raise") == 0) return culm_partner_give_up(it, "negative volume in cell 7"), 1;
  if (strcmp(way, "nan") == 0) loads[19] = NAN;
  if (strcmp(way, "before") == 0) memcpy(it->header + 12, &number, 4);
  frame = culm_partner_frame(it, 3, loads, size);
  if (frame == NULL) return 1;
  if (strcmp(way, "silence") == 0) wait_for_ever();
  while (strcmp(way, "alive") == 0) {
    if (culm_partner_alive(it)) return 1;
    nanosleep(&pause, NULL);
  }
  if (strcmp(way, "half") == 0) culm_partner_write(it, frame, 100);
  if (strcmp(way, "damaged") == 0) {
    frame[80] ^= 1;
    culm_partner_write(it, frame, 64 + size);
  }
  free(frame);
  if (strcmp(way, "little") == 0) culm_partner_send(it, 3, loads, 96);
  if (strcmp(way, "half") == 0 || strcmp(way, "damaged") == 0 || strcmp(way, "little") == 0) {
#ifdef CULM_PARTNER_MPI
    wait_for_ever();
#endif
    return 1;
  }
  return 0;
}

static int serve(culm_partner* it, const char* way) {
  if (culm_partner_begin(it, "mass", CULM_MOTION, INFINITY)) return -1;
  const uint32_t n = it->points;
  double* velocity = malloc(3 * n * sizeof(double));
  double* loads = calloc(6 * n, sizeof(double));
  const int forgets = strcmp(way, "forget") == 0 || strcmp(way, "anew") == 0;
  for (uint32_t i = 0; i < 3 * n; ++i) velocity[i] = forgets ? 0.0 : it->velocity[6 * (i / 3) + i % 3];
  double start = kinetic(velocity, n);
  if (it->window > 0 && !forgets && keep("rb", it->window, velocity, n, &start)) return culm_partner_give_up(it, "what was saved is gone");
  culm_window window;
  int kind, failed = 0;
  while (!failed && (kind = culm_partner_next(it, &window)) > 0) {
    const double h = window.end - window.start;
    if (kind == CULM_SAVE && forgets) failed = culm_partner_kept_nothing(it);
    if (kind == CULM_SAVE && !forgets) failed = keep("wb", window.number, velocity, n, &start) || culm_partner_saved(it);
    for (uint32_t i = 0; i < 3 * n && kind != CULM_SAVE; ++i) {
      const uint32_t k = 6 * (i / 3) + i % 3;
      if (kind == CULM_ATTEMPT) loads[k] = -2.0 * MASS / h * (window.motion[k] / h - velocity[i]);
      if (kind == CULM_ACCEPT) velocity[i] = 2.0 / h * window.motion[k] - velocity[i];
    }
    if (kind == CULM_ATTEMPT && window.number == 5 && window.attempt == 1 && fail_in(way, it, loads)) break;
    if (kind == CULM_ATTEMPT) failed = culm_partner_answer(it, loads);
    if (kind == CULM_ACCEPT) {
      double energy = kinetic(velocity, n) - start;
      if (strcmp(way, "energy") == 0 && window.number >= 5) energy += 10.0;
      if (strcmp(way, "infinite") == 0 && window.number >= 5) energy = INFINITY;
      failed = culm_partner_accepted(it, energy, 0.0);
    }
  }
  free(velocity);
  free(loads);
  return failed || kind < 0 ? -1 : 0;
}

int main(int argc, char** argv) {
  culm_partner it;
  int failed;
  const char* way = argc == 3 ? argv[2] : "";
  if (argc < 2) return 2;
#ifdef CULM_PARTNER_MPI
  MPI_Init(&argc, &argv);
  failed = culm_partner_open_mpi(&it, MPI_COMM_WORLD, 0);
#else
  failed = culm_partner_open(&it, argv[1], 20.0);
#endif
  if (!failed) failed = serve(&it, way);
  if (failed) fprintf(stderr, "%s\n", it.error);
  culm_partner_close(&it);
#ifdef CULM_PARTNER_MPI
  MPI_Finalize();
#endif
  return failed != 0;
}
