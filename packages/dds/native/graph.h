/* One participant of a domain, and what it knows about the others. */
#ifndef FARPOINT_GRAPH_H
#define FARPOINT_GRAPH_H

#include <dds/dds.h>
#include <stdbool.h>
#include <stddef.h>

#include "raw_type.h"

struct graph;

/* `changed` is called on a thread of CycloneDDS whenever a publisher or subscriber appears or disappears. */
dds_return_t graph_open(dds_domainid_t id, const char *configuration, void (*changed)(void *), void *context,
                        struct graph **to);
/* `changed` is not called afterwards. The participant ends with the last of its readers and writers. */
void graph_close(struct graph *graph);

struct topic_quality {
  bool reliable;
  bool transient_local;
  int32_t depth;
  /* Told to all that match; empty: none. Must outlive the call only. */
  const char *user_data;
};

/* Common part of readers and writers; the type is referenced. */
struct endpoint {
  struct graph *graph;
  dds_entity_t topic;
  dds_entity_t entity;
  struct ddsi_sertype *type;
};

dds_return_t graph_reader(struct graph *graph, const char *topic, const char *type, struct topic_quality quality,
                          dds_listener_t *listener, struct endpoint *to);
dds_return_t graph_writer(struct graph *graph, const char *topic, const char *type, struct topic_quality quality,
                          struct endpoint *to);
/* Waits for running listeners; none is called afterwards. */
void endpoint_delete(struct endpoint *endpoint);

/*
 * Calls `visit` for each publisher (or subscriber) of other participants, up to a limit; `reliable` and
 * `transient_local` are what it offers (or requests).
 */
dds_return_t graph_others(struct graph *graph, bool publishers,
                          void (*visit)(void *, const char *topic, const char *type, bool reliable, bool transient_local),
                          void *context);

/*
 * Calls `visit` for each endpoint that is matched now with a writer (then they are readers) or a reader, up to a limit:
 * with its identity on the network, and its user data up to the first zero, empty if it has none.
 */
dds_return_t endpoint_matched(const struct endpoint *endpoint, bool is_writer,
                              void (*visit)(void *, const dds_guid_t *guid, const char *user_data), void *context);

#endif
