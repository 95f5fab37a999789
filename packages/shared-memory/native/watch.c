#include "watch.h"

#include <linux/futex.h>
#include <pthread.h>
#include <stdlib.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

#include "clock.h"

/* How often a thread that sleeps on a futex wakes up to check whether it should end or the file is gone. */
static const int64_t LONGEST_FUTEX_WAIT_NS = 50 * 1000 * 1000;

struct watch {
  struct mapping *mapping;
  struct watch_place place;
  void (*report)(enum watch_outcome, void *);
  void *context;
  pthread_t thread;
  pthread_mutex_t lock;
  pthread_cond_t changed;
  bool armed;
  bool stopping;
  struct watch_order order;
};

static int64_t look(struct watch *watch, uint32_t *value) {
  return watch->place.futex ? mapping_load32(watch->mapping, watch->place.offset, value)
                            : mapping_load8(watch->mapping, watch->place.offset, value);
}

static void futex_wait(struct watch *watch, uint32_t value, int64_t ns) {
  const struct timespec timeout = {.tv_sec = ns / NS_PER_S, .tv_nsec = ns % NS_PER_S};
  syscall(SYS_futex, watch->mapping->base + watch->place.offset, FUTEX_WAIT, value, &timeout, NULL, 0);
}

/* Call with the lock held; returns early if the watch is to end. */
static void pause_until(struct watch *watch, int64_t until_ns) {
  const struct timespec until = to_timespec(until_ns);
  while (!watch->stopping && now_ns() < until_ns) {
    pthread_cond_timedwait(&watch->changed, &watch->lock, &until);
  }
}

/* Call with the lock held; releases it while waiting on the futex. */
static enum watch_outcome follow(struct watch *watch, struct watch_order order) {
  const int64_t started = now_ns();
  const int64_t deadline = started + (int64_t)order.timeout_ms * NS_PER_MS;
  bool quiet = order.quiet_us > 0;
  while (!watch->stopping) {
    uint32_t value = 0;
    if (look(watch, &value) >= 0) return WATCH_FAULT;
    if (value != order.value) return WATCH_CHANGED;
    const int64_t now = now_ns();
    if (now >= deadline) return WATCH_TIMEOUT;
    if (watch->place.futex) {
      const int64_t left = deadline - now;
      pthread_mutex_unlock(&watch->lock);
      futex_wait(watch, order.value, left < LONGEST_FUTEX_WAIT_NS ? left : LONGEST_FUTEX_WAIT_NS);
      pthread_mutex_lock(&watch->lock);
      continue;
    }
    const int64_t next = quiet ? started + (int64_t)order.quiet_us * NS_PER_US : now + (int64_t)order.poll_us * NS_PER_US;
    quiet = false;
    pause_until(watch, next < deadline ? next : deadline);
  }
  return WATCH_TIMEOUT;
}

static void *run(void *argument) {
  struct watch *watch = argument;
  pthread_mutex_lock(&watch->lock);
  while (!watch->stopping) {
    if (!watch->armed) {
      pthread_cond_wait(&watch->changed, &watch->lock);
      continue;
    }
    const enum watch_outcome outcome = follow(watch, watch->order);
    watch->armed = false;
    if (!watch->stopping) watch->report(outcome, watch->context);
  }
  pthread_mutex_unlock(&watch->lock);
  return NULL;
}

struct watch *watch_start(struct mapping *mapping, struct watch_place place,
                          void (*report)(enum watch_outcome, void *), void *context) {
  struct watch *watch = calloc(1, sizeof *watch);
  if (watch == NULL) return NULL;
  watch->mapping = mapping_retain(mapping);
  watch->place = place;
  watch->report = report;
  watch->context = context;
  pthread_mutex_init(&watch->lock, NULL);
  init_condition(&watch->changed);
  if (pthread_create(&watch->thread, NULL, run, watch) != 0) {
    mapping_release(mapping);
    free(watch);
    return NULL;
  }
  pthread_setname_np(watch->thread, "farpoint-watch");
  return watch;
}

void watch_arm(struct watch *watch, struct watch_order order) {
  pthread_mutex_lock(&watch->lock);
  if (!watch->armed) {
    watch->order = order;
    watch->armed = true;
    pthread_cond_signal(&watch->changed);
  }
  pthread_mutex_unlock(&watch->lock);
}

void watch_stop(struct watch *watch) {
  pthread_mutex_lock(&watch->lock);
  watch->stopping = true;
  pthread_cond_signal(&watch->changed);
  pthread_mutex_unlock(&watch->lock);
  if (watch->place.futex) mapping_wake(watch->mapping, watch->place.offset);
  pthread_join(watch->thread, NULL);
  pthread_cond_destroy(&watch->changed);
  pthread_mutex_destroy(&watch->lock);
  mapping_release(watch->mapping);
  free(watch);
}
