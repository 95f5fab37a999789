/*
 * A reader with a bounded queue. A thread of CycloneDDS puts samples in, the program takes them out; who comes to a full
 * queue pushes the oldest out, and that is counted.
 */
#ifndef FARPOINT_READER_H
#define FARPOINT_READER_H

#include <stddef.h>
#include <stdint.h>

#include "graph.h"

struct reader;

/* `wake` is called from that thread when the queue is no longer empty, once until reader_rest. */
dds_return_t reader_open(struct graph *graph, const char *topic, const char *type, struct topic_quality quality,
                         size_t queue, void (*wake)(void *), void *context, struct reader **to);
void reader_close(struct reader *reader);

/* The next `wake` may come; returns how many samples wait. */
size_t reader_rest(struct reader *reader);

/*
 * Takes the oldest sample: its bytes to `to`, where there is `room` for them, and the time (CLOCK_MONOTONIC, ns) at which
 * it was whole. Returns its size; where that is more than `room` the sample stays. -1 where none waits.
 */
int64_t reader_take(struct reader *reader, uint8_t *to, size_t room, int64_t *received_ns);

struct reader_counts {
  uint64_t received;
  uint64_t dropped;
  /* That never came: known from gaps in the numbers that did. */
  uint32_t lost;
  uint32_t publishers;
};

struct reader_counts reader_counts(struct reader *reader);

#endif
