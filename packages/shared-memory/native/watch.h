/* A thread that waits until a byte or word of a mapping differs from a given value, and then reports that once. */
#ifndef FARPOINT_WATCH_H
#define FARPOINT_WATCH_H

#include <stdbool.h>
#include <stdint.h>

#include "mapping.h"

enum watch_outcome { WATCH_CHANGED = 0, WATCH_TIMEOUT = 1, WATCH_FAULT = 2 };

struct watch_place {
  size_t offset;
  /* A 32-bit word that its writer wakes with a futex; otherwise a byte that is polled. */
  bool futex;
};

struct watch_order {
  uint32_t value;
  /* After a first check, waits for this long before polling. */
  uint32_t quiet_us;
  /* Polling interval without a futex. */
  uint32_t poll_us;
  uint32_t timeout_ms;
};

struct watch;

/* `report` is called on the watch's own thread, once for each order. NULL if no thread could be created. */
struct watch *watch_start(struct mapping *mapping, struct watch_place place,
                          void (*report)(enum watch_outcome outcome, void *context), void *context);
void watch_arm(struct watch *watch, struct watch_order order);
/* Ends the thread; nothing is reported afterwards. */
void watch_stop(struct watch *watch);

#endif
