#include "log.h"

#include <dds/ddsrt/log.h>
#include <pthread.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

enum { LONGEST = 512, AT_ONCE = 3, SECONDS_BETWEEN = 10 };

static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
static char last[LONGEST];
/* Lines that may be written now, lines that were suppressed, and when the last one was allowed. */
static unsigned allowed = AT_ONCE;
static uint64_t held_back;
static time_t since;

static void sink(void *context, const dds_log_data_t *data) {
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  pthread_mutex_lock(&lock);
  snprintf(last, sizeof last, "%s", data->message);
  last[strcspn(last, "\n")] = 0;
  if (now.tv_sec - since >= SECONDS_BETWEEN && allowed < AT_ONCE) {
    allowed++;
    since = now.tv_sec;
  }
  if (allowed > 0) {
    if (allowed == AT_ONCE) since = now.tv_sec;
    allowed--;
    fprintf(stderr, "CycloneDDS: %s\n", last);
    if (held_back > 0) fprintf(stderr, "CycloneDDS: and %llu more lines\n", (unsigned long long)held_back);
    held_back = 0;
  } else {
    held_back++;
  }
  pthread_mutex_unlock(&lock);
}

void log_install(void) { dds_set_log_sink(sink, NULL); }

void log_take(char *to, size_t room) {
  pthread_mutex_lock(&lock);
  snprintf(to, room, "%s", last);
  last[0] = 0;
  pthread_mutex_unlock(&lock);
}
