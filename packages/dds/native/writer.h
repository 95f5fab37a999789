/* A writer for samples that are already serialised. */
#ifndef FARPOINT_WRITER_H
#define FARPOINT_WRITER_H

#include <stddef.h>
#include <stdint.h>

#include "graph.h"

struct writer;

dds_return_t writer_open(struct graph *graph, const char *topic, const char *type, struct topic_quality quality,
                         struct writer **to);
void writer_close(struct writer *writer);

/* Never blocks: DDS_RETCODE_TIMEOUT if a reliable subscriber has not acknowledged enough. */
dds_return_t writer_write(struct writer *writer, const uint8_t *bytes, size_t count);

uint32_t writer_subscribers(struct writer *writer);
const struct endpoint *writer_endpoint(const struct writer *writer);

#endif
