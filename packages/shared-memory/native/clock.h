/* CLOCK_MONOTONIC in nanoseconds, and condition variables that use it. */
#ifndef FARPOINT_CLOCK_H
#define FARPOINT_CLOCK_H

#include <pthread.h>
#include <stdint.h>
#include <time.h>

static const int64_t NS_PER_US = 1000;
static const int64_t NS_PER_MS = 1000 * 1000;
static const int64_t NS_PER_S = 1000 * 1000 * 1000;

static inline int64_t now_ns(void) {
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec * NS_PER_S + now.tv_nsec;
}

static inline struct timespec to_timespec(int64_t ns) {
  return (struct timespec){.tv_sec = ns / NS_PER_S, .tv_nsec = ns % NS_PER_S};
}

static inline void init_condition(pthread_cond_t *condition) {
  pthread_condattr_t attributes;
  pthread_condattr_init(&attributes);
  pthread_condattr_setclock(&attributes, CLOCK_MONOTONIC);
  pthread_cond_init(condition, &attributes);
  pthread_condattr_destroy(&attributes);
}

#endif
