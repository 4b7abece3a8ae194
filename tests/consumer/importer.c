/* Loads an FMU of the mast and blows at it: each step is repeated from a state that was kept until drag and motion fit.
 * usage: importer FOLDER IDENTIFIER STEP [RESULTS] */
#include "fmi3.h"
#include <dlfcn.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { POINTS = 6, FORCE = 16, POSITION = 19, MOTION = 23, WORK = 24, RESULTS = 1 };

static char said[4096];

static void note(fmi3InstanceEnvironment environment, fmi3Status status, fmi3String category, fmi3String message) {
  (void)environment, (void)status, (void)category;
  snprintf(said, sizeof said, "%s", message);
}

static void *library;

static void *find(const char *name) {
  void *found = dlsym(library, name);
  if (found == NULL) {
    fprintf(stderr, "the FMU has no %s\n", name);
    exit(1);
  }
  return found;
}

/* A pointer to a function is no pointer to an object in C: by their bytes. */
#define FIND(name)                         \
  do {                                     \
    void *found = find(#name);             \
    memcpy(&name##_, &found, sizeof found); \
  } while (0)

static void expect(int line, fmi3Status status, fmi3Status expected, const char *words) {
  if (status == expected && strstr(said, words) != NULL) {
    said[0] = '\0';
    return;
  }
  fprintf(stderr, "line %d: status %d instead of %d, '%s' instead of '%s'\n", line, status, expected, said, words);
  exit(1);
}
#define EXPECT(call, expected, words) expect(__LINE__, call, expected, words)

int main(int argc, char **argv) {
  char path[4096], resources[4096];
  const char *(*fmi3GetVersion_)(void);
  fmi3Instance (*fmi3InstantiateCoSimulation_)(fmi3String, fmi3String, fmi3String, fmi3Boolean, fmi3Boolean, fmi3Boolean,
                                               fmi3Boolean, const fmi3ValueReference[], size_t, fmi3InstanceEnvironment,
                                               fmi3LogMessageCallback, fmi3IntermediateUpdateCallback);
  fmi3Status (*fmi3EnterInitializationMode_)(fmi3Instance, fmi3Boolean, fmi3Float64, fmi3Float64, fmi3Boolean, fmi3Float64);
  fmi3Status (*fmi3ExitInitializationMode_)(fmi3Instance);
  fmi3Status (*fmi3SetFloat64_)(fmi3Instance, const fmi3ValueReference[], size_t, const fmi3Float64[], size_t);
  fmi3Status (*fmi3GetFloat64_)(fmi3Instance, const fmi3ValueReference[], size_t, fmi3Float64[], size_t);
  fmi3Status (*fmi3SetString_)(fmi3Instance, const fmi3ValueReference[], size_t, const fmi3String[], size_t);
  fmi3Status (*fmi3GetInt32_)(fmi3Instance, const fmi3ValueReference[], size_t, fmi3Int32[], size_t);
  fmi3Status (*fmi3GetFMUState_)(fmi3Instance, fmi3FMUState *);
  fmi3Status (*fmi3SetFMUState_)(fmi3Instance, fmi3FMUState);
  fmi3Status (*fmi3FreeFMUState_)(fmi3Instance, fmi3FMUState *);
  fmi3Status (*fmi3DoStep_)(fmi3Instance, fmi3Float64, fmi3Float64, fmi3Boolean, fmi3Boolean *, fmi3Boolean *, fmi3Boolean *,
                            fmi3Float64 *);
  fmi3Status (*fmi3Terminate_)(fmi3Instance);
  void (*fmi3FreeInstance_)(fmi3Instance);
  const fmi3ValueReference force_of = FORCE, position_of = POSITION, motion_of = MOTION, work_of = WORK, results_of = RESULTS;
  const fmi3ValueReference both[2] = {0, WORK}, none = 99;
  double force[3 * POINTS] = {0}, motion[6 * POINTS], position[3 * POINTS], two[2], done, last, work = 0.0, time = 0.0;
  fmi3Boolean event, over, early;
  fmi3FMUState start = NULL;
  fmi3Instance mast;
  int p, i, steps;
  if (argc < 4) return 2;
  snprintf(path, sizeof path, "%s/binaries/x86_64-linux/%s.so", argv[1], argv[2]);
  snprintf(resources, sizeof resources, "%s/resources/", argv[1]);
  library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
  if (library == NULL) {
    fprintf(stderr, "%s\n", dlerror());
    return 1;
  }
  FIND(fmi3GetVersion);
  FIND(fmi3InstantiateCoSimulation);
  FIND(fmi3EnterInitializationMode);
  FIND(fmi3ExitInitializationMode);
  FIND(fmi3SetFloat64);
  FIND(fmi3GetFloat64);
  FIND(fmi3SetString);
  FIND(fmi3GetInt32);
  FIND(fmi3GetFMUState);
  FIND(fmi3SetFMUState);
  FIND(fmi3FreeFMUState);
  FIND(fmi3DoStep);
  FIND(fmi3Terminate);
  FIND(fmi3FreeInstance);
  if (strcmp(fmi3GetVersion_(), "3.0") != 0) return 3;

  if (fmi3InstantiateCoSimulation_("no mast", "", "/nowhere/", false, false, false, false, NULL, 0, NULL, note, NULL) != NULL)
    return 4;
  EXPECT(fmi3Error, fmi3Error, "/nowhere//deck.xml");
  mast = fmi3InstantiateCoSimulation_("mast", "", resources, false, false, false, false, NULL, 0, NULL, note, NULL);
  if (mast == NULL) {
    fprintf(stderr, "%s\n", said);
    return 1;
  }
  said[0] = '\0';
  EXPECT(fmi3DoStep_(mast, 0.0, 0.02, false, &event, &over, &early, &last), fmi3Error, "after the initialization");
  if (argc > 4) EXPECT(fmi3SetString_(mast, &results_of, 1, (const char *const *)&argv[4], 1), fmi3OK, "");
  EXPECT(fmi3EnterInitializationMode_(mast, false, 0.0, 0.0, true, 1.0), fmi3OK, "");
  EXPECT(fmi3ExitInitializationMode_(mast), fmi3OK, "");
  EXPECT(fmi3GetFloat64_(mast, &none, 1, force, 1), fmi3Error, "no variable of reference 99 to get");
  EXPECT(fmi3SetFloat64_(mast, &motion_of, 1, motion, 6 * POINTS), fmi3Error, "no variable of reference 23 to set");
  EXPECT(fmi3SetFloat64_(mast, &force_of, 1, force, 17), fmi3Error, "17 values are not as many");
  EXPECT(fmi3GetInt32_(mast, &none, 1, NULL, 0), fmi3Error, "Int32");
  EXPECT(fmi3DoStep_(mast, 0.5, 0.02, false, &event, &over, &early, &last), fmi3Error, "the structure is at 0.0");
  force[4] = NAN;
  EXPECT(fmi3SetFloat64_(mast, &force_of, 1, force, 3 * POINTS), fmi3OK, "");
  EXPECT(fmi3DoStep_(mast, 0.0, 0.02, false, &event, &over, &early, &last), fmi3Error, "for the force at point 1");
  force[4] = 0.0;

  steps = (int)lround(1.0 / atof(argv[3]));
  for (i = 1; i <= steps; ++i) {
    /* as culm's own steps add up, so that both make the same ones */
    const double end = i == steps ? 1.0 : time + atof(argv[3]), h = end - time;
    double change = 1.0;
    EXPECT(fmi3GetFMUState_(mast, &start), fmi3OK, "");
    while (change > 1e-9) {
      EXPECT(fmi3SetFMUState_(mast, start), fmi3OK, "");
      EXPECT(fmi3SetFloat64_(mast, &force_of, 1, force, 3 * POINTS), fmi3OK, "");
      EXPECT(fmi3DoStep_(mast, time, h, false, &event, &over, &early, &last), fmi3OK, "");
      EXPECT(fmi3GetFloat64_(mast, &motion_of, 1, motion, 6 * POINTS), fmi3OK, "");
      EXPECT(fmi3GetFloat64_(mast, both, 2, two, 2), fmi3OK, "");
      if (two[0] != last) return 5;
      done = two[1];
      change = 0.0;
      for (p = 0; p < POINTS; ++p) {
        const double wind = 20.0 - motion[6 * p] / h;
        const double drag = 0.24 * wind * fabs(wind);
        change = fmax(change, fabs(drag - force[3 * p]));
        force[3 * p] = drag;
      }
    }
    work += done;
    time = last;
  }
  EXPECT(fmi3GetFloat64_(mast, &position_of, 1, position, 3 * POINTS), fmi3OK, "");
  EXPECT(fmi3GetFloat64_(mast, &work_of, 1, &done, 1), fmi3OK, "");
  EXPECT(fmi3DoStep_(mast, time, 0.5, false, &event, &over, &early, &last), fmi3Error, "it ends at 1.0");
  EXPECT(fmi3DoStep_(mast, time, INFINITY, false, &event, &over, &early, &last), fmi3Error, "a step of inf s");
  EXPECT(fmi3FreeFMUState_(mast, &start), fmi3OK, "");
  if (start != NULL) return 6;
  EXPECT(fmi3Terminate_(mast), fmi3OK, "");
  fmi3FreeInstance_(mast);

  /* importers do so for each simulation */
  dlclose(library);
  library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
  if (library == NULL) return 7;
  FIND(fmi3InstantiateCoSimulation);
  FIND(fmi3FreeInstance);
  mast = fmi3InstantiateCoSimulation_("mast again", "", resources, false, false, false, false, NULL, 0, NULL, note, NULL);
  if (mast == NULL) return 8;
  fmi3FreeInstance_(mast);
  printf("%.10f m, %.10f J\n", position[15], work);
  return 0;
}
