#include "writer.h"

#include <stdlib.h>

struct writer {
  struct endpoint endpoint;
};

dds_return_t writer_open(struct graph *graph, const char *topic, const char *type, struct topic_quality quality,
                         struct writer **to) {
  struct writer *writer = calloc(1, sizeof *writer);
  if (writer == NULL) return DDS_RETCODE_OUT_OF_RESOURCES;
  const dds_return_t result = graph_writer(graph, topic, type, quality, &writer->endpoint);
  if (result < 0) {
    free(writer);
    return result;
  }
  *to = writer;
  return DDS_RETCODE_OK;
}

void writer_close(struct writer *writer) {
  endpoint_delete(&writer->endpoint);
  free(writer);
}

dds_return_t writer_write(struct writer *writer, const uint8_t *bytes, size_t count) {
  struct ddsi_serdata *sample = raw_sample_new(writer->endpoint.type, bytes, count);
  if (sample == NULL) return DDS_RETCODE_OUT_OF_RESOURCES;
  /* Takes over the reference, whatever the result. */
  return dds_writecdr(writer->endpoint.entity, sample);
}

const struct endpoint *writer_endpoint(const struct writer *writer) { return &writer->endpoint; }

uint32_t writer_subscribers(struct writer *writer) {
  dds_publication_matched_status_t matched = {0};
  dds_get_publication_matched_status(writer->endpoint.entity, &matched);
  return matched.current_count;
}
