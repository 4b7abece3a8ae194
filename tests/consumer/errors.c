/* What the C interface answers to wrong calls, and that a detour leaves no trace. */
#include <culm.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static culm_simulation *mast;

static void expect(int line, int code, int expected, const char *words) {
  const char *text = culm_error(mast);
  if (code == expected && strstr(text, words) != NULL) return;
  fprintf(stderr, "line %d: code %d instead of %d, '%s' instead of '%s'\n", line, code, expected, text, words);
  exit(1);
}
#define EXPECT(call, expected, words) expect(__LINE__, call, expected, words)

int main(int argc, char **argv) {
  const char *overrides[] = {"Analyses/gust/Step=0.05"};
  const char *structures[] = {"mast"};
  const double cloud[] = {0.2, 0.0, 3.0, 0.0, -0.1, 7.0};
  double force[6] = {30.0, 0.0, 5.0, 0.0, 20.0, 0.0}, moment[6] = {1.0, 2.0, 3.0, 0.0, 0.0, 0.0};
  double first[12], again[12], end, last, work, resultant[3], about[3];
  int over, points, converged;
  const char *promises;
  culm_snapshot *start = NULL;
  if (argc < 2) return 1;

  EXPECT(culm_open(CULM_API_VERSION + 1000, CULM_WORLD, argv[1], NULL, 0, &mast), CULM_USAGE, "version 2003");
  EXPECT(culm_open(CULM_API_VERSION, CULM_WORLD, "missing.xml", NULL, 0, &mast), CULM_FILE, "missing.xml");
  EXPECT(culm_begin(NULL, NULL), CULM_USAGE, "NULL");
  EXPECT(culm_open(CULM_API_VERSION, CULM_WORLD, argv[1], NULL, 1, &mast), CULM_USAGE, "the array is NULL");
  EXPECT(culm_open(CULM_API_VERSION, CULM_WORLD, argv[1], overrides, 1, &mast), CULM_OK, "");
  if (strstr(culm_messages(mast), "port 'skin': 6 points") == NULL) return 2;

  EXPECT(culm_proposal(mast, &end), CULM_USAGE, "culm_begin");
  EXPECT(culm_add_port(mast, "net", cloud, 2, structures, 1, 0.1, 0), CULM_USAGE, "point 0 at (0.2, 0, 3)");
  EXPECT(culm_add_port(mast, "net", cloud, 2, structures, 1, 0.5, 1), CULM_OK, "");
  EXPECT(culm_add_port(mast, "net", cloud, 2, NULL, 0, 0.0, 0), CULM_USAGE, "already");
  EXPECT(culm_port_size(mast, "net", &points), CULM_OK, "");
  if (points != 2) return 3;
  EXPECT(culm_port_reference(mast, "net", first, 6), CULM_OK, "");
  if (fabs(first[2] - 3.0) > 1e-14 || fabs(first[4] + 0.1) > 1e-14) return 4;

  EXPECT(culm_begin(mast, "gast"), CULM_USAGE, "gust");
  EXPECT(culm_begin(mast, "gust"), CULM_OK, "");
  EXPECT(culm_write_results(mast, "late"), CULM_USAGE, "before the first 'begin'");
  EXPECT(culm_close_results(mast), CULM_USAGE, "no results are written");
  EXPECT(culm_write_results(mast, NULL), CULM_USAGE, "NULL");
  EXPECT(culm_is_at_end(mast, &over), CULM_OK, "");
  EXPECT(culm_proposal(mast, &end), CULM_OK, "");
  if (over || fabs(end - 0.05) > 1e-15) return 5;
  EXPECT(culm_final_time(mast, &last), CULM_OK, "");
  EXPECT(culm_is_exhausted(mast, &over), CULM_OK, "");
  if (last != 1.0 || over) return 8;
  EXPECT(culm_time(mast, NULL), CULM_USAGE, "no place for the result: it is NULL");
  EXPECT(culm_port_size(mast, "net", NULL), CULM_USAGE, "no place for the result");
  EXPECT(culm_save(mast, NULL), CULM_USAGE, "no place for the result");
  EXPECT(culm_port_size(mast, NULL, &points), CULM_USAGE, "there is no name: it is NULL");
  EXPECT(culm_set_load(mast, NULL, force, 6), CULM_USAGE, "there is no name: it is NULL");
  EXPECT(culm_accept(mast), CULM_USAGE, "");
  EXPECT(culm_port_set(mast, "nett", force, NULL, 2), CULM_USAGE, "did you mean 'net'?");
  EXPECT(culm_port_set(mast, "net", force, NULL, 1), CULM_USAGE, "takes 6 values of force, got 3");
  moment[4] = NAN;
  EXPECT(culm_port_set(mast, "net", force, moment, 2), CULM_NOT_FINITE, "point 1");
  moment[4] = 0.0;
  EXPECT(culm_port_set(mast, "net", force, moment, 2), CULM_OK, "");
  EXPECT(culm_port_read(mast, "net", 5, first, 12), CULM_USAGE, "quantity");
  EXPECT(culm_port_read(mast, "net", CULM_MOTION, first, 11), CULM_USAGE, "room for 11 values, there are 12");

  EXPECT(culm_save(mast, &start), CULM_OK, "");
  EXPECT(culm_attempt(mast, end, &converged), CULM_OK, "");
  EXPECT(culm_port_read(mast, "net", CULM_MOTION, first, 12), CULM_OK, "");
  EXPECT(culm_port_exchange(mast, "net", &work, resultant, about), CULM_OK, "");
  if (!converged || work <= 0.0 || resultant[0] != 30.0 || resultant[1] != 20.0) return 6;
  {
    const int corners[8] = {0, 1, 0, -1, 0, 1, 2, -1};
    EXPECT(culm_port_set_pressure(mast, "net", corners, 1, NULL, NULL), CULM_USAGE, "face 0 names a point twice");
    EXPECT(culm_port_set_pressure(mast, "net", corners + 4, 1, NULL, NULL), CULM_USAGE, "face 0 names point 2");
    EXPECT(culm_port_set_pressure(mast, "net", corners, 0, NULL, NULL), CULM_OK, "");
    EXPECT(culm_port_set(mast, "net", force, moment, 2), CULM_OK, "");
  }
  EXPECT(culm_accept(mast), CULM_USAGE, "set after it: attempt again");
  EXPECT(culm_discard(mast), CULM_OK, "");
  EXPECT(culm_attempt(mast, 0.5 * end, &converged), CULM_OK, "");
  EXPECT(culm_accept(mast), CULM_OK, "");
  EXPECT(culm_restore(mast, start), CULM_OK, "");
  EXPECT(culm_attempt(mast, end, &converged), CULM_OK, "");
  EXPECT(culm_port_read(mast, "net", CULM_MOTION, again, 12), CULM_OK, "");
  if (memcmp(first, again, sizeof first) != 0) return 7;
  culm_snapshot_free(start);
  EXPECT(culm_finish(mast), CULM_OK, "");
  EXPECT(culm_broken_promises(mast, &promises), CULM_OK, "");
  if (strcmp(promises, "") != 0) return 9;
  culm_close(mast);
  culm_end();
  mast = NULL;
  EXPECT(culm_open(CULM_API_VERSION, CULM_WORLD, argv[1], overrides, 1, &mast), CULM_USAGE, "'culm_end' was called");
  printf("C: wrong calls are refused\n");
  return 0;
}
