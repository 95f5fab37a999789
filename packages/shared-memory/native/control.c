#include "control.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include "clock.h"

/* If a zero could not be written (because the file is being recreated), it is retried after this time. */
static const int64_t RETRY_NS = 5 * 1000 * 1000;

struct control {
  struct mapping *block;
  struct mapping *busy;
  int64_t silence_ns;
  pthread_t thread;
  pthread_mutex_t lock;
  pthread_cond_t changed;
  bool stopping;
  bool moving;
  int64_t written_ns;
  int32_t counter;
  uint32_t silences;
};

/* With the lock held. */
static int64_t put(struct control *control, const double values[CONTROL_VALUES]) {
  uint8_t block[CONTROL_BYTES];
  control->counter = (int32_t)((uint32_t)control->counter + 1);
  memcpy(block, &control->counter, sizeof control->counter);
  memcpy(block + sizeof control->counter, values, CONTROL_VALUES * sizeof(double));
  mapping_store8(control->busy, 0, 1);
  __atomic_thread_fence(__ATOMIC_SEQ_CST);
  const int64_t fault = mapping_copy_in(control->block, 0, block, sizeof block);
  mapping_store8(control->busy, 0, 0);
  return fault;
}

static void *run(void *argument) {
  static const double zero[CONTROL_VALUES] = {0};
  struct control *control = argument;
  pthread_mutex_lock(&control->lock);
  while (!control->stopping) {
    if (!control->moving) {
      pthread_cond_wait(&control->changed, &control->lock);
      continue;
    }
    const int64_t deadline = control->written_ns + control->silence_ns;
    if (now_ns() < deadline) {
      const struct timespec until = to_timespec(deadline);
      pthread_cond_timedwait(&control->changed, &control->lock, &until);
      continue;
    }
    if (put(control, zero) < 0) {
      control->moving = false;
      control->silences++;
    } else {
      control->written_ns = now_ns() - control->silence_ns + RETRY_NS;
    }
  }
  pthread_mutex_unlock(&control->lock);
  return NULL;
}

struct control *control_start(struct mapping *block, struct mapping *busy, uint32_t silence_ms) {
  struct control *control = calloc(1, sizeof *control);
  if (control == NULL) return NULL;
  control->block = mapping_retain(block);
  control->busy = mapping_retain(busy);
  control->silence_ns = (int64_t)silence_ms * NS_PER_MS;
  /* A relay recognises a running writer by a counter that changes, so ours continues where the last one ended. */
  mapping_copy_out(block, 0, &control->counter, sizeof control->counter);
  pthread_mutex_init(&control->lock, NULL);
  init_condition(&control->changed);
  if (pthread_create(&control->thread, NULL, run, control) != 0) {
    mapping_release(block);
    mapping_release(busy);
    free(control);
    return NULL;
  }
  pthread_setname_np(control->thread, "farpoint-wheels");
  return control;
}

int64_t control_write(struct control *control, const double values[CONTROL_VALUES], int32_t *counter) {
  pthread_mutex_lock(&control->lock);
  const int64_t fault = put(control, values);
  bool moving = false;
  for (int i = 0; i < CONTROL_VALUES; i++) moving = moving || values[i] != 0;
  /* If a zero could not be written, the dead man keeps working. */
  if (fault < 0 || moving) control->moving = moving;
  control->written_ns = now_ns();
  *counter = control->counter;
  pthread_cond_signal(&control->changed);
  pthread_mutex_unlock(&control->lock);
  return fault;
}

uint32_t control_silences(struct control *control) {
  pthread_mutex_lock(&control->lock);
  const uint32_t silences = control->silences;
  pthread_mutex_unlock(&control->lock);
  return silences;
}

void control_stop(struct control *control) {
  static const double zero[CONTROL_VALUES] = {0};
  pthread_mutex_lock(&control->lock);
  put(control, zero);
  control->stopping = true;
  pthread_cond_signal(&control->changed);
  pthread_mutex_unlock(&control->lock);
  pthread_join(control->thread, NULL);
  pthread_cond_destroy(&control->changed);
  pthread_mutex_destroy(&control->lock);
  mapping_release(control->block);
  mapping_release(control->busy);
  free(control);
}
