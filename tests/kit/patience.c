// Preloaded into tests on several processes. A rank of Open MPI that waits asks for messages over and
// over, with sched_yield in between. Where ranks and other tests are more than cores, the kernel still
// gives it most of a time slice each time, and what takes a second alone took minutes. So a rank that
// has done nothing else for a while sleeps: then those that work have the core at once, and a message
// comes a moment later.
#define _GNU_SOURCE

#include <sched.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

enum { asks_before_sleep = 200, nanoseconds_of_sleep = 20000, nanoseconds_of_an_ask = 5000 };

int sched_yield(void) {
  static __thread long last = 0;
  static __thread int asks = 0;
  struct timespec used;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &used);
  const long now = used.tv_sec * 1000000000L + used.tv_nsec;
  asks = now - last < nanoseconds_of_an_ask ? asks + 1 : 0;  // more: it has worked in between
  last = now;
  if (asks < asks_before_sleep) return (int)syscall(SYS_sched_yield);
  const struct timespec sleep = {0, nanoseconds_of_sleep};
  return nanosleep(&sleep, 0);
}
