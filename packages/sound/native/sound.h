/* What the parts of the program share: one microphone or one loudspeaker, one pipeline. */
#ifndef FARPOINT_SOUND_H
#define FARPOINT_SOUND_H

#include <gst/gst.h>
#include <stdbool.h>
#include <stdint.h>

#include "fault.h"

enum { MESSAGE_PLAY = 3, MESSAGE_SOUND = 65 };

/* What is captured or played. */
typedef struct {
  /* The pipeline's text; the elements that we look for have names that begin with farpoint-. */
  char *pipeline;
  /* Whether it is a loudspeaker's. */
  bool plays;
  guint silence_ms;
} Opening;

typedef struct {
  GMainLoop *loop;
  Opening opening;
  GstElement *pipeline, *encoder, *packets;
  guint bits_per_s;
  /* Atomic: packets that left the encoder, or that came for the decoder. */
  guint came;
  GMutex lock;
  /* Under the lock. */
  guint64 bytes;
} Sound;

/* pipeline.c */
bool pipeline_start(Sound *sound);
void pipeline_stop(Sound *sound);

/* capture.c */
void capture_attach(Sound *sound, GstElement *sink);
void capture_configure(Sound *sound);

/* play.c: one packet, and when it is to be heard. */
void play_packet(Sound *sound, const uint8_t *payload, gsize size);

#endif
