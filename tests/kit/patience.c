// Preloaded into tests on several processes. A rank of Open MPI that waits asks for messages over and
// over, with sched_yield in between. Where ranks and other programs are more than cores, the kernel
// gives the core to another one for a time slice and back to the rank that waits, and what takes a
// second alone takes minutes. So where a yield took long, which shows that others want the core, a rank
// sleeps between the questions that follow: then those that work have the core at once, and a message
// comes a moment later.
#define _GNU_SOURCE

#include <sched.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

enum { nanoseconds_of_sleep = 20000, nanoseconds_of_long_yield = 1000000, sleeps_after_long_yield = 100 };

static long now(void) {
  struct timespec time;
  clock_gettime(CLOCK_MONOTONIC, &time);
  return time.tv_sec * 1000000000L + time.tv_nsec;
}

int sched_yield(void) {
  static __thread int sleeps = 0;
  if (sleeps > 0) {
    --sleeps;
    const struct timespec sleep = {0, nanoseconds_of_sleep};
    return nanosleep(&sleep, 0);
  }
  const long before = now();
  const int result = (int)syscall(SYS_sched_yield);
  if (now() - before > nanoseconds_of_long_yield) sleeps = sleeps_after_long_yield;
  return result;
}
