/* Be the partner of culm from a program in C or C++: the wire format over sockets or MPI, in one header without culm.
 *
 *   culm_partner it;
 *   culm_window window;
 *   int kind;
 *   if (culm_partner_open(&it, "unix:/tmp/wind", 600.0)) fail(it.error);
 *   if (culm_partner_begin(&it, "wind", CULM_POSITION | CULM_MOTION, INFINITY)) fail(it.error);
 *   while ((kind = culm_partner_next(&it, &window)) > 0) {
 *     if (kind == CULM_ATTEMPT) { ... fill loads ... culm_partner_answer(&it, loads); }
 *     if (kind == CULM_ACCEPT) { ... culm_partner_accepted(&it, energy, heat); }
 *     if (kind == CULM_SAVE) { ... culm_partner_saved(&it); }   or culm_partner_kept_nothing
 *   }
 *   if (kind < 0) fail(it.error);
 *   culm_partner_close(&it);
 *
 * Where the program shall lead, culm follows (culm serve DECK --at unix:/tmp/wind):
 *
 *   if (culm_partner_open(&it, "unix:/tmp/wind", 600.0)) fail(it.error);
 *   if (culm_structure_begin(&it, "wind", CULM_MOTION)) fail(it.error);
 *   while (it.proposal > it.time) {
 *     ... fill loads ...
 *     if (culm_structure_attempt(&it, it.proposal, loads, &window) < 0) fail(it.error);   1 converged, 0 not; again and again
 *     if (culm_structure_accept(&it)) fail(it.error);
 *   }
 *   culm_structure_end(&it);
 *
 * culm listens and leads. Each attempt is answered as if it were the first of its window. Functions return 0, or -1 and
 * say in `error` why. Link with zlib (-lz). With CULM_PARTNER_MPI defined, culm_partner_open_mpi speaks with a culm
 * in the same mpiexec. For long answers call culm_partner_alive from time to time, once in a second at least as often as
 * culm's Patience asks for. doc/developer/wire_format.md describes the bytes; they are little-endian, as this code is.
 */
#ifndef CULM_PARTNER_H
#define CULM_PARTNER_H

#ifndef _POSIX_C_SOURCE
#define _POSIX_C_SOURCE 200809L
#endif

#include <errno.h>
#include <math.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <time.h>
#include <unistd.h>
#include <zlib.h>
#ifdef CULM_PARTNER_MPI
#include <mpi.h>
#endif

/* Quantities of points, as bits, with 3, 9, 6, 6 and 6 numbers each. */
enum { CULM_POSITION = 1, CULM_ROTATION = 2, CULM_VELOCITY = 4, CULM_ACCELERATION = 8, CULM_MOTION = 16 };

/* What culm says. */
enum { CULM_BYE = 0, CULM_ATTEMPT = 2, CULM_ACCEPT = 4, CULM_SAVE = 6 };

/* A window of time and how the points move in it, point by point; null what was not asked for. */
typedef struct {
  uint32_t number, attempt; /* from 0 */
  double start, end;        /* [s] */
  const double* position;   /* 3 at the end [m] */
  const double* rotation;   /* 9 against the reference, row by row */
  const double* velocity;   /* 6 at the end [m/s, rad/s] */
  const double* acceleration;
  const double* motion; /* 6, displacement and rotation vector in the window [m, rad] */
  const double* loads;  /* 6, that acted, once the window is over [N, N m] */
} culm_window;

typedef struct {
  char error[256];
  uint32_t points;
  const double* reference; /* 3 per point [m] */
  const double* velocity;  /* 6 per point at the start */
  const char* port;
  double start;    /* [s] */
  uint32_t window; /* above 0: the run goes on from what was saved under this number */
  /* where culm follows: accepted time, where it would go next, equal at the end, and where that is [s] */
  double time, proposal, final_time;
  double step_work, work; /* of the loads in the last step, and so far [J] */
  /* inside */
  int socket;
  double patience;
  uint32_t wanted, steps, attempts;
  char *hello, *payload;
  size_t room;
  unsigned char header[64];
#ifdef CULM_PARTNER_MPI
  MPI_Comm comm;
  int rank;
#endif
} culm_partner;

static int culm_partner_fail(culm_partner* it, const char* what) {
  snprintf(it->error, sizeof it->error, "%s", what);
  return -1;
}

/* The bytes of a frame about what was asked last, to be freed; NULL if there is no memory. */
static char* culm_partner_frame(const culm_partner* it, uint16_t kind, const void* payload, uint64_t size) {
  const uint16_t version = 1;
  uint32_t sum;
  char* frame = (char*)calloc(1, 64 + (size_t)size);
  if (frame == NULL) return NULL;
  memcpy(frame, "CULM", 4);
  memcpy(frame + 4, &version, 2);
  memcpy(frame + 6, &kind, 2);
  memcpy(frame + 8, it->header + 8, 24); /* window, attempt, start, end */
  memcpy(frame + 32, &size, 8);
  sum = (uint32_t)crc32(0, (const Bytef*)frame, 40);
  if (size > 0) {
    sum = (uint32_t)crc32_z(sum, (const Bytef*)payload, (z_size_t)size);
    memcpy(frame + 64, payload, (size_t)size);
  }
  memcpy(frame + 40, &sum, 4);
  return frame;
}

static int culm_partner_write(culm_partner* it, const char* bytes, size_t length) {
  size_t done = 0;
#ifdef CULM_PARTNER_MPI
  if (it->socket < 0) {
    MPI_Send(bytes, (int)length, MPI_BYTE, it->rank, 0, it->comm);
    return 0;
  }
#endif
  while (done < length) {
    const ssize_t n = send(it->socket, bytes + done, length - done, MSG_NOSIGNAL);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return culm_partner_fail(it, "culm is gone");
    done += (size_t)n;
  }
  return 0;
}

static int culm_partner_send(culm_partner* it, uint16_t kind, const void* payload, uint64_t size) {
  char* frame = culm_partner_frame(it, kind, payload, size);
  int failed;
  if (frame == NULL) return culm_partner_fail(it, "there is no memory for a frame");
  failed = culm_partner_write(it, frame, 64 + (size_t)size);
  free(frame);
  return failed;
}

static int culm_partner_read(culm_partner* it, char* to, size_t size) {
  size_t done = 0;
  while (done < size) {
    struct pollfd entry = {it->socket, POLLIN, 0};
    ssize_t n;
    const double patience = it->patience < 2e6 ? it->patience : 2e6;
    const int found = poll(&entry, 1, (int)(1000.0 * patience));
    if (found < 0 && errno == EINTR) continue;
    if (found == 0) return culm_partner_fail(it, "culm said nothing for too long");
    n = recv(it->socket, to + done, size - done, 0);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return culm_partner_fail(it, "culm is gone without a word");
    done += (size_t)n;
  }
  return 0;
}

static int culm_partner_make_room(culm_partner* it, uint64_t size) {
  char* more;
  if (size < it->room) return 0;
  if (size >= SIZE_MAX / 2) return culm_partner_fail(it, "a frame is damaged");
  more = (char*)realloc(it->payload, (size_t)size + 1); /* with an end for texts */
  if (more == NULL) return culm_partner_fail(it, "there is no memory for a frame");
  it->payload = more;
  it->room = (size_t)size + 1;
  return 0;
}

static uint64_t culm_partner_size(const culm_partner* it) {
  uint64_t size;
  memcpy(&size, it->header + 32, 8);
  return size;
}

#ifdef CULM_PARTNER_MPI
static int culm_partner_receive_mpi(culm_partner* it) {
  MPI_Status status;
  int length;
  MPI_Probe(it->rank, 0, it->comm, &status);
  MPI_Get_count(&status, MPI_BYTE, &length);
  if (length < 64 || culm_partner_make_room(it, (uint64_t)length)) return culm_partner_fail(it, "what came is no frame");
  MPI_Recv(it->payload, length, MPI_BYTE, it->rank, 0, it->comm, MPI_STATUS_IGNORE);
  memcpy(it->header, it->payload, 64);
  if (culm_partner_size(it) != (uint64_t)length - 64) return culm_partner_fail(it, "a frame is damaged");
  memmove(it->payload, it->payload + 64, (size_t)length - 64);
  return 0;
}
#endif

/* Kind of the next frame that is more than a sign of life. */
static int culm_partner_receive(culm_partner* it) {
  uint16_t kind, version;
  uint32_t sum, wanted;
  do {
#ifdef CULM_PARTNER_MPI
    if (it->socket < 0) {
      if (culm_partner_receive_mpi(it)) return -1;
    } else
#endif
    {
      if (culm_partner_read(it, (char*)it->header, 64)) return -1;
      if (memcmp(it->header, "CULM", 4) != 0) return culm_partner_fail(it, "what came is no frame of culm");
      if (culm_partner_make_room(it, culm_partner_size(it))) return -1;
      if (culm_partner_read(it, it->payload, (size_t)culm_partner_size(it))) return -1;
    }
    memcpy(&version, it->header + 4, 2);
    memcpy(&kind, it->header + 6, 2);
    memcpy(&sum, it->header + 40, 4);
    if (version != 1) return culm_partner_fail(it, "culm speaks another version of the wire format");
    wanted = (uint32_t)crc32(0, it->header, 40);
    if (culm_partner_size(it) > 0)
      wanted = (uint32_t)crc32_z(wanted, (const Bytef*)it->payload, (z_size_t)culm_partner_size(it));
    if (sum != wanted) return culm_partner_fail(it, "a frame is damaged");
  } while (kind == 8);
  it->payload[culm_partner_size(it)] = '\0';
  return kind;
}

/* Goes to culm. address: 'unix:PATH' or 'tcp:[HOST:]PORT'; culm may take so long to begin, and be silent for so long [s]. */
static int culm_partner_open(culm_partner* it, const char* address, double patience) {
  const time_t end = time(NULL) + (time_t)(patience < 1e9 ? patience : 1e9);
  const struct timespec pause = {0, 10000000};
  memset(it, 0, sizeof *it);
  it->patience = patience;
  do {
    int found = -1;
    it->socket = -1;
    if (strncmp(address, "unix:", 5) == 0) {
      struct sockaddr_un place;
      memset(&place, 0, sizeof place);
      place.sun_family = AF_UNIX;
      if (strlen(address + 5) >= sizeof place.sun_path) return culm_partner_fail(it, "the path of the socket is too long");
      strcpy(place.sun_path, address + 5);
      it->socket = socket(AF_UNIX, SOCK_STREAM, 0);
      found = connect(it->socket, (struct sockaddr*)&place, sizeof place);
    } else if (strncmp(address, "tcp:", 4) == 0) {
      char host[256] = "127.0.0.1";
      const char* colon = strrchr(address + 4, ':');
      struct addrinfo hints, *all;
      const int on = 1;
      if (colon != NULL) snprintf(host, sizeof host, "%.*s", (int)(colon - address - 4), address + 4);
      memset(&hints, 0, sizeof hints);
      hints.ai_socktype = SOCK_STREAM;
      if (getaddrinfo(host, colon ? colon + 1 : address + 4, &hints, &all) != 0)
        return culm_partner_fail(it, "there is no such address");
      it->socket = socket(all->ai_family, SOCK_STREAM, 0);
      found = connect(it->socket, all->ai_addr, all->ai_addrlen);
      setsockopt(it->socket, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
      freeaddrinfo(all);
    } else {
      return culm_partner_fail(it, "an address is 'unix:PATH' or 'tcp:[HOST:]PORT'");
    }
    if (found == 0) return 0;
    if (it->socket >= 0) close(it->socket);
    it->socket = -1;
    nanosleep(&pause, NULL);
  } while (time(NULL) < end);
  return culm_partner_fail(it, "nobody listens at the address");
}

#ifdef CULM_PARTNER_MPI
/* Speaks with the culm whose first rank is this rank of a communicator. */
static int culm_partner_open_mpi(culm_partner* it, MPI_Comm comm, int rank) {
  memset(it, 0, sizeof *it);
  it->socket = -1;
  it->comm = comm;
  it->rank = rank;
  return 0;
}
#endif

/* Hears where the points are and says what it wants to know of them. longest: window that it takes [s], may be INFINITY. */
static int culm_partner_begin(culm_partner* it, const char* name, uint32_t wanted, double longest) {
  char hello[16 + 256];
  size_t length = strlen(name);
  if (culm_partner_receive(it) != 1) return it->error[0] ? -1 : culm_partner_fail(it, "culm did not begin with hello");
  if (culm_partner_size(it) >= 4) memcpy(&it->points, it->payload, 4);
  if (culm_partner_size(it) < 4 + 72 * (uint64_t)it->points) {
    return culm_partner_fail(it, "a frame has another length than it must");
  }
  memcpy(&it->start, it->header + 16, 8);
  memcpy(&it->window, it->header + 8, 4);
  it->hello = it->payload;
  memmove(it->hello, it->hello + 4, (size_t)culm_partner_size(it) - 3); /* for whole doubles */
  it->payload = NULL;
  it->room = 0;
  it->reference = (const double*)it->hello;
  it->velocity = it->reference + 3 * (size_t)it->points;
  it->port = (const char*)(it->velocity + 6 * (size_t)it->points);
  it->wanted = wanted;
  if (length > 255) length = 255;
  memcpy(hello, &it->points, 4);
  memcpy(hello + 4, &wanted, 4);
  memcpy(hello + 8, &longest, 8);
  memcpy(hello + 16, name, length);
  return culm_partner_send(it, 1, hello, 16 + length);
}

/* Numbers of each point that are wanted. */
static uint64_t culm_partner_width(const culm_partner* it) {
  static const int widths[5] = {3, 9, 6, 6, 6};
  uint64_t count = 0;
  int i;
  for (i = 0; i < 5; ++i) count += (it->wanted >> i & 1) ? (uint64_t)widths[i] : 0;
  return count;
}

/* Finds what is wanted in a payload; returns what comes behind. */
static const double* culm_partner_quantities(const culm_partner* it, const double* at, culm_window* window) {
  static const int widths[5] = {3, 9, 6, 6, 6};
  const double** places[5];
  int i;
  places[0] = &window->position;
  places[1] = &window->rotation;
  places[2] = &window->velocity;
  places[3] = &window->acceleration;
  places[4] = &window->motion;
  for (i = 0; i < 5; ++i) {
    if (!(it->wanted >> i & 1)) continue;
    *places[i] = at;
    at += (size_t)widths[i] * it->points;
  }
  return at;
}

/* What culm wants next: CULM_ATTEMPT, CULM_ACCEPT, CULM_SAVE, CULM_BYE; -1 for an error. */
static int culm_partner_next(culm_partner* it, culm_window* window) {
  const double* at;
  uint64_t count;
  int kind = culm_partner_receive(it);
  memset(window, 0, sizeof *window);
  if (kind < 0) return -1;
  if (kind == 9 || kind == 10) {
    if (kind == 10) snprintf(it->error, sizeof it->error, "culm says: %.240s", it->payload);
    return CULM_BYE;
  }
  memcpy(&window->number, it->header + 8, 4);
  memcpy(&window->attempt, it->header + 12, 4);
  memcpy(&window->start, it->header + 16, 8);
  memcpy(&window->end, it->header + 24, 8);
  if (kind == CULM_SAVE) return kind;
  if (kind != CULM_ATTEMPT && kind != CULM_ACCEPT) return culm_partner_fail(it, "culm says what has no meaning here");
  count = culm_partner_width(it);
  if (kind == CULM_ACCEPT) count += 6;
  if (culm_partner_size(it) != 8 * count * it->points) return culm_partner_fail(it, "a frame has another length than it must");
  at = culm_partner_quantities(it, (const double*)it->payload, window);
  if (kind == CULM_ACCEPT) window->loads = at;
  return kind;
}

/* Mean force and moment of each point in the window [N, N m]. */
static int culm_partner_answer(culm_partner* it, const double* loads) {
  return culm_partner_send(it, 3, loads, 48 * (uint64_t)it->points);
}

/* Energy that it holds more than at the start, and what it has turned into heat [J]; NAN for both, in all windows, if it
 * keeps no books. */
static int culm_partner_accepted(culm_partner* it, double energy, double dissipated) {
  const double books[2] = {energy, dissipated};
  return culm_partner_send(it, 5, books, sizeof books);
}

/* It has kept itself under the number of the window. */
static int culm_partner_saved(culm_partner* it) { return culm_partner_send(it, 7, NULL, 0); }

/* It cannot keep itself: if the run is resumed, it begins anew, and culm warns of that. */
static int culm_partner_kept_nothing(culm_partner* it) { return culm_partner_send(it, 7, "nothing", 7); }

/* While it computes for long. */
static int culm_partner_alive(culm_partner* it) { return culm_partner_send(it, 8, NULL, 0); }

/* It cannot go on; culm ends with this text. */
static int culm_partner_give_up(culm_partner* it, const char* why) { return culm_partner_send(it, 10, why, strlen(why)); }

/* --- culm follows --------------------------------------------------------------------------------- */

/* What the next frame is about: window of time (or a number to save under), attempt, start, end. */
static void culm_structure_about(culm_partner* it, uint32_t number, uint32_t attempt, double end) {
  memcpy(it->header + 8, &number, 4);
  memcpy(it->header + 12, &attempt, 4);
  memcpy(it->header + 16, &it->time, 8);
  memcpy(it->header + 24, &end, 8);
}

/* Hears one answer; its text, where culm cannot go on. */
static int culm_structure_answer(culm_partner* it, int expected, uint32_t number) {
  uint32_t answered;
  const int kind = culm_partner_receive(it);
  if (kind == 10) snprintf(it->error, sizeof it->error, "culm says: %.240s", it->payload);
  if (kind < 0 || kind == 10) return -1;
  memcpy(&answered, it->header + 8, 4);
  if (kind != expected || answered != number) return culm_partner_fail(it, "culm answered something else");
  return 0;
}

/* The same, of all but attempts: where the run is. */
static int culm_structure_state(culm_partner* it, int expected, uint32_t number) {
  if (culm_structure_answer(it, expected, number)) return -1;
  if (culm_partner_size(it) != 16) return culm_partner_fail(it, "a frame has another length than it must");
  memcpy(&it->time, it->header + 16, 8);
  memcpy(&it->proposal, it->header + 24, 8);
  memcpy(&it->step_work, it->payload, 8);
  memcpy(&it->work, it->payload + 8, 8);
  return 0;
}

static int culm_structure_do(culm_partner* it, uint16_t kind, uint32_t number) {
  culm_structure_about(it, number, it->attempts, it->time);
  if (culm_partner_send(it, kind, NULL, 0)) return -1;
  return culm_structure_state(it, kind + 1, number);
}

/* Meets culm serve and says what shall be known of the points after attempts. */
static int culm_structure_begin(culm_partner* it, const char* name, uint32_t wanted) {
  if (culm_partner_begin(it, name, wanted, INFINITY)) return -1;
  memcpy(&it->final_time, it->header + 24, 8);
  it->steps = it->attempts = 0;
  if (it->final_time <= it->start) return culm_partner_fail(it, "culm leads here: start it by 'culm serve'");
  return culm_structure_state(it, 5, 0);
}

/* Tries a step to `end` under mean forces and moments, 6 per point [N, N m]. 1: converged, and the window says how the
 * points moved; 0: not; -1: an error. */
static int culm_structure_attempt(culm_partner* it, double end, const double* loads, culm_window* window) {
  double converged;
  culm_structure_about(it, it->steps, it->attempts, end);
  if (culm_partner_send(it, 2, loads, 48 * (uint64_t)it->points)) return -1;
  memset(window, 0, sizeof *window);
  window->number = it->steps;
  window->attempt = it->attempts++;
  window->start = it->time;
  window->end = end;
  if (culm_structure_answer(it, 3, it->steps)) return -1;
  if (culm_partner_size(it) < 8) return culm_partner_fail(it, "a frame has another length than it must");
  memcpy(&converged, it->payload, 8);
  if (converged == 0.0) return 0;
  if (culm_partner_size(it) != 8 + 8 * culm_partner_width(it) * it->points) {
    return culm_partner_fail(it, "a frame has another length than it must");
  }
  culm_partner_quantities(it, (const double*)it->payload + 1, window);
  return 1;
}

/* Makes the last attempt, which converged, the accepted state. */
static int culm_structure_accept(culm_partner* it) {
  if (culm_structure_do(it, 4, it->steps)) return -1;
  ++it->steps;
  it->attempts = 0;
  return 0;
}

/* Forgets the last attempt. */
static int culm_structure_discard(culm_partner* it) { return culm_structure_do(it, 11, it->steps); }

/* Forgets it because it was not good: the proposal is nearer. An error where none is left. */
static int culm_structure_fail(culm_partner* it) { return culm_structure_do(it, 13, it->steps); }

/* Keeps the accepted state in culm's memory under a number, and goes back to it, results as well. */
static int culm_structure_save(culm_partner* it, uint32_t number) { return culm_structure_do(it, 6, number); }
static int culm_structure_restore(culm_partner* it, uint32_t number) { return culm_structure_do(it, 15, number); }

/* Lets culm write a checkpoint, from which `culm resume` goes on; keep yourself under the same number, above 0. In a run
 * that goes on the number is `window` of culm_partner, else 0. */
static int culm_structure_keep(culm_partner* it, uint32_t number) { return culm_structure_do(it, 18, number); }

/* The end; then culm_partner_close. */
static int culm_structure_end(culm_partner* it) { return culm_partner_send(it, 9, NULL, 0); }

static void culm_partner_close(culm_partner* it) {
  if (it->socket >= 0) close(it->socket);
  free(it->hello);
  free(it->payload);
  it->hello = it->payload = NULL;
}

#endif
