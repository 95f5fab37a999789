#include "reader.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

struct waiting {
  struct ddsi_serdata *sample;
  int64_t received_ns;
};

struct reader {
  struct endpoint endpoint;
  void (*wake)(void *);
  void *context;
  pthread_mutex_t lock;
  /* With the lock held: */
  bool awake;
  uint64_t received;
  uint64_t dropped;
  size_t first;
  size_t count;
  size_t room;
  struct waiting ring[];
};

static int64_t now_ns(void) {
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return (int64_t)now.tv_sec * 1000000000 + now.tv_nsec;
}

/* With the lock held. */
static struct ddsi_serdata *pop(struct reader *reader) {
  struct ddsi_serdata *sample = reader->ring[reader->first].sample;
  reader->first = (reader->first + 1) % reader->room;
  reader->count--;
  return sample;
}

static void push(struct reader *reader, struct ddsi_serdata *sample) {
  struct ddsi_serdata *oldest = NULL;
  const int64_t received_ns = now_ns();
  pthread_mutex_lock(&reader->lock);
  if (reader->count == reader->room) {
    oldest = pop(reader);
    reader->dropped++;
  }
  reader->ring[(reader->first + reader->count) % reader->room] =
      (struct waiting){.sample = sample, .received_ns = received_ns};
  reader->count++;
  reader->received++;
  const bool wake = !reader->awake;
  reader->awake = true;
  pthread_mutex_unlock(&reader->lock);
  if (oldest != NULL) ddsi_serdata_unref(oldest);
  if (wake) reader->wake(reader->context);
}

static void on_data(dds_entity_t entity, void *argument) {
  enum { AT_ONCE = 16 };
  struct reader *reader = argument;
  struct ddsi_serdata *samples[AT_ONCE];
  dds_sample_info_t infos[AT_ONCE];
  dds_return_t count;
  do {
    memset(samples, 0, sizeof samples);
    count = dds_takecdr(entity, samples, AT_ONCE, infos, DDS_ANY_STATE);
    for (dds_return_t i = 0; i < count; i++) {
      /* Without data: a writer is gone. */
      if (infos[i].valid_data && samples[i]->kind == SDK_DATA) push(reader, samples[i]);
      else ddsi_serdata_unref(samples[i]);
    }
  } while (count == AT_ONCE);
}

dds_return_t reader_open(struct graph *graph, const char *topic, const char *type, struct topic_quality quality,
                         size_t queue, void (*wake)(void *), void *context, struct reader **to) {
  struct reader *reader = calloc(1, sizeof *reader + queue * sizeof reader->ring[0]);
  if (reader == NULL) return DDS_RETCODE_OUT_OF_RESOURCES;
  reader->wake = wake;
  reader->context = context;
  reader->room = queue;
  pthread_mutex_init(&reader->lock, NULL);
  dds_listener_t *listener = dds_create_listener(reader);
  dds_lset_data_available(listener, on_data);
  const dds_return_t result = graph_reader(graph, topic, type, quality, listener, &reader->endpoint);
  dds_delete_listener(listener);
  if (result < 0) {
    pthread_mutex_destroy(&reader->lock);
    free(reader);
    return result;
  }
  *to = reader;
  return DDS_RETCODE_OK;
}

void reader_close(struct reader *reader) {
  endpoint_delete(&reader->endpoint);
  while (reader->count > 0) ddsi_serdata_unref(pop(reader));
  pthread_mutex_destroy(&reader->lock);
  free(reader);
}

size_t reader_rest(struct reader *reader) {
  pthread_mutex_lock(&reader->lock);
  reader->awake = false;
  const size_t count = reader->count;
  pthread_mutex_unlock(&reader->lock);
  return count;
}

int64_t reader_take(struct reader *reader, uint8_t *to, size_t room, int64_t *received_ns) {
  pthread_mutex_lock(&reader->lock);
  if (reader->count == 0) {
    pthread_mutex_unlock(&reader->lock);
    return -1;
  }
  const struct waiting *oldest = &reader->ring[reader->first];
  const struct raw_bytes bytes = raw_sample_bytes(oldest->sample);
  if (bytes.count > room) {
    pthread_mutex_unlock(&reader->lock);
    return (int64_t)bytes.count;
  }
  *received_ns = oldest->received_ns;
  struct ddsi_serdata *sample = pop(reader);
  pthread_mutex_unlock(&reader->lock);
  if (bytes.count > 0) memcpy(to, bytes.at, bytes.count);
  ddsi_serdata_unref(sample);
  return (int64_t)bytes.count;
}

const struct endpoint *reader_endpoint(const struct reader *reader) { return &reader->endpoint; }

struct reader_counts reader_counts(struct reader *reader) {
  struct reader_counts counts = {0};
  dds_sample_lost_status_t lost = {0};
  dds_subscription_matched_status_t matched = {0};
  dds_get_sample_lost_status(reader->endpoint.entity, &lost);
  dds_get_subscription_matched_status(reader->endpoint.entity, &matched);
  counts.lost = lost.total_count;
  counts.publishers = matched.current_count;
  pthread_mutex_lock(&reader->lock);
  counts.received = reader->received;
  counts.dropped = reader->dropped;
  pthread_mutex_unlock(&reader->lock);
  return counts;
}
