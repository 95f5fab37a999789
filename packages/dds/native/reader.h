/*
 * A reader with a bounded queue. A thread of CycloneDDS adds samples, the program takes them out. A sample that finds
 * the queue full replaces the oldest, which is counted.
 */
#ifndef FARPOINT_READER_H
#define FARPOINT_READER_H

#include <stddef.h>
#include <stdint.h>

#include "graph.h"

struct reader;

/* `wake` is called on that thread when the queue is no longer empty, once until reader_rest. */
dds_return_t reader_open(struct graph *graph, const char *topic, const char *type, struct topic_quality quality,
                         size_t queue, void (*wake)(void *), void *context, struct reader **to);
void reader_close(struct reader *reader);

/* Allows the next `wake`; returns how many samples wait. */
size_t reader_rest(struct reader *reader);

/*
 * Takes the oldest sample: copies its bytes to `to` if there is `room` for them, and stores the time (CLOCK_MONOTONIC,
 * ns) at which it was complete. Returns its size; if that exceeds `room`, the sample stays. Returns -1 if none waits.
 */
int64_t reader_take(struct reader *reader, uint8_t *to, size_t room, int64_t *received_ns);

struct reader_counts {
  uint64_t received;
  uint64_t dropped;
  /* Samples that never arrived, according to gaps in the sequence numbers. */
  uint32_t lost;
  uint32_t publishers;
};

struct reader_counts reader_counts(struct reader *reader);
const struct endpoint *reader_endpoint(const struct reader *reader);

#endif
