/* culm for other programs: a deck's model, step by step, with ports. Plain C; the binary interface
 * is stable: functions are added, never changed.
 *
 * Every function but culm_api_version, culm_error, culm_messages and the last ones of a life
 * (culm_close, culm_snapshot_free, culm_end) returns CULM_OK or why not; then nothing was changed
 * that is not said. A step that does not converge is no error. Numbers are in SI units, vectors in
 * space, one row after the other. On several MPI ranks all functions are called on all ranks alike,
 * with the same values. No function may be called by two threads at once. */
#ifndef CULM_H
#define CULM_H

#ifdef __cplusplus
extern "C" {
#endif

#if defined(__GNUC__)
#define CULM_API __attribute__((visibility("default")))
#else
#define CULM_API
#endif

/* What this header describes: major * 1000 + minor. culm_open compares it with the library. */
#define CULM_API_VERSION 1003

/* The communicator of all ranks, for culm_open. */
#define CULM_WORLD (-1)

/* Outcomes; the exit codes of the program. */
enum {
  CULM_OK = 0,
  CULM_INTERNAL = 1,   /* a mistake of culm itself */
  CULM_USAGE = 2,      /* a wrong call: order, name, number of values */
  CULM_INPUT = 3,      /* the deck is wrong */
  CULM_NUMERICAL = 4,  /* singular, or no equilibrium where one must be */
  CULM_NOT_FINITE = 5, /* a value is infinite or not a number */
  CULM_FILE = 6        /* a file cannot be read or written */
};

/* What a port shows of each of its points. A step is open from an attempt until it is accepted or
 * not; between steps motion and acceleration are zero. */
enum {
  CULM_POSITION = 0,     /* at the end of the open step, or now [m]: 3 */
  CULM_ROTATION = 1,     /* against the reference, a matrix row by row: 9 */
  CULM_VELOCITY = 2,     /* and angular velocity at the same time [m/s, rad/s]: 6 */
  CULM_ACCELERATION = 3, /* and angular acceleration, mean of the open step [m/s^2, rad/s^2]: 6 */
  CULM_MOTION = 4        /* in the open step, and rotation vector 2 tan(angle / 2), what loads work
                            on [m, rad]: 6 */
};

typedef struct culm_simulation culm_simulation;
typedef struct culm_snapshot culm_snapshot;

/* The version of the library, as CULM_API_VERSION. */
CULM_API int culm_api_version(void);

/* What the last call with this simulation that failed has to say; of NULL, the last call without
 * one, such as a culm_open that failed. Valid until the next call. */
CULM_API const char* culm_error(const culm_simulation* simulation);
/* What culm said since the last call of this: notes and warnings. Valid until the next call. */
CULM_API const char* culm_messages(culm_simulation* simulation);

/* Builds the model of a deck. Starts Trilinos, and MPI where the program has not and a launcher or
 * `comm` ask for it.
 *   api        CULM_API_VERSION
 *   comm       MPI_Comm_c2f of a communicator, or CULM_WORLD
 *   overrides  such as "Structures/beam/Curve/Elements=32"; `count` of them, NULL if none */
CULM_API int culm_open(int api, int comm, const char* deck, const char* const* overrides, int count,
                       culm_simulation** simulation);
/* Ends a simulation; NULL is allowed. Snapshots of it are of no use afterwards. */
CULM_API void culm_close(culm_simulation* simulation);
/* Ends what culm_open started, after the last culm_close; for programs that end MPI themselves. Else
 * it happens when the program ends. Every call after it is refused. */
CULM_API void culm_end(void);

/* --- steps; the verbs of doc/developer/life_of_a_step.md ---------------------------------------- */

/* Writes results into a folder as culm run does: of each step when it is accepted, cut back by culm_restore. Before the
 * first culm_begin; without it nothing is written. Since 1003. */
CULM_API int culm_write_results(culm_simulation* simulation, const char* folder);
/* Ends the analysis that was taken up, and the files with a report; what was written before is sound without it. Since
 * 1003. */
CULM_API int culm_close_results(culm_simulation* simulation);
/* Takes up an analysis of the deck that makes steps, the first one if `analysis` is NULL. What was taken up before ends,
 * unless the deck has no such analysis. */
CULM_API int culm_begin(culm_simulation* simulation, const char* analysis);
/* Time [s] or level of the accepted state. */
CULM_API int culm_time(culm_simulation* simulation, double* time);
/* Where the next step should go. */
CULM_API int culm_proposal(culm_simulation* simulation, double* target);
CULM_API int culm_is_at_end(culm_simulation* simulation, int* is_at_end);
/* Where the last step ends: a time [s] or a level; infinite where nobody knows, as on paths. Since 1002. */
CULM_API int culm_final_time(culm_simulation* simulation, double* time);
/* Solves a step from the accepted state to `target` with the loads as they are. */
CULM_API int culm_attempt(culm_simulation* simulation, double target, int* converged);
/* Makes the attempt the accepted state. */
CULM_API int culm_accept(culm_simulation* simulation);
/* Goes back as if the attempt had not been made. */
CULM_API int culm_discard(culm_simulation* simulation);
/* Goes back; the next proposal is nearer. */
CULM_API int culm_fail(culm_simulation* simulation);
/* Whether nothing nearer than the last failure may be tried: the analysis has come to nothing. Since 1002. */
CULM_API int culm_is_exhausted(culm_simulation* simulation, int* is_exhausted);
/* Ends the analysis. */
CULM_API int culm_finish(culm_simulation* simulation);
/* Names the promises that did not hold in the analyses so far, such as the balance of energy, in one line; empty if all
 * do. Analyses look at theirs at the latest in culm_finish. Valid until the next call of this. Since 1002. */
CULM_API int culm_broken_promises(culm_simulation* simulation, const char** text);
/* The accepted state, in memory; loads are not in it. Where results are written, going back cuts them, so that later
 * snapshots are refused from then on. */
CULM_API int culm_save(culm_simulation* simulation, culm_snapshot** snapshot);
CULM_API int culm_restore(culm_simulation* simulation, const culm_snapshot* snapshot);
CULM_API void culm_snapshot_free(culm_snapshot* snapshot);

/* --- loads and ports ---------------------------------------------------------------------------- */

/* Sets a load of type External: force and moment of each node, `size` values in all. */
CULM_API int culm_set_load(culm_simulation* simulation, const char* load, const double* values,
                           int size);
/* Attaches points to the nearest of some structures, before the first culm_begin.
 *   xyz         3 numbers per point, in the reference
 *   structures  `count` names; NULL: all
 *   reach       how far they may be away; 0: any distance
 *   smooth      1: points between the nodes of lines move by smooth weights; 0: as the elements */
CULM_API int culm_add_port(culm_simulation* simulation, const char* port, const double* xyz,
                           int points, const char* const* structures, int count, double reach,
                          int smooth);
/* How many ports there are, and their names by number from 0, valid until the next call of this. Since 1003. */
CULM_API int culm_port_count(culm_simulation* simulation, int* count);
CULM_API int culm_port_name(culm_simulation* simulation, int number, const char** name);
/* The number of points of a port. */
CULM_API int culm_port_size(culm_simulation* simulation, const char* port, int* points);
/* Positions in the reference. `size` values, 3 per point. */
CULM_API int culm_port_reference(culm_simulation* simulation, const char* port, double* values,
                                 int size);
/* A quantity of all points. `size` values: points times what one has. */
CULM_API int culm_port_read(culm_simulation* simulation, const char* port, int quantity,
                            double* values, int size);
/* Sets the loads of all attempts from now on: in dynamics means over the step.
 *   forces, moments  3 numbers per point, on `points` points; moments may be NULL: zero */
CULM_API int culm_port_set(culm_simulation* simulation, const char* port, const double* forces,
                           const double* moments, int points);
/* Sets the forces to those of pressure and traction on faces between the points, mean over the step that is open.
 *   corners   four points of each of `faces` faces, by number, anticlockwise seen from outside; -1 last: a triangle
 *   pressure  one number per face [Pa], pushes inwards; NULL: zero
 *   traction  three numbers per face, in space [Pa]; NULL: zero */
CULM_API int culm_port_set_pressure(culm_simulation* simulation, const char* port,
                                    const int* corners, int faces, const double* pressure,
                                    const double* traction);
/* What the loads do in the open step: work, resultant, moment about the origin. Each may be NULL. */
CULM_API int culm_port_exchange(culm_simulation* simulation, const char* port, double* work,
                                double force[3], double moment[3]);
/* Draws the points in the reference, as a VTU file. */
CULM_API int culm_port_write(culm_simulation* simulation, const char* port, const char* path);

#ifdef __cplusplus
}
#endif

#endif
