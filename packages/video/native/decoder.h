#ifndef FARPOINT_DECODER_H
#define FARPOINT_DECODER_H

#include "video.h"

/* One decoder; only one thread uses it. Zero it, and set the last two. */
typedef struct {
  Coding coding;
  GstElement *pipeline;
  GstPad *feed, *decoded;
  GstCaps *decoded_caps;
  /* Called for each decoded picture, which it may keep by a reference of its own. */
  void (*on_picture)(gpointer data, GstBuffer *buffer, GstCaps *caps);
  gpointer data;
} Decoder;

/* Replaces the decoder. Returns NULL, or why there is none, for g_free(). */
char *decoder_open(Decoder *decoder, Coding coding);

/* Takes the buffer. Returns once it is done with; false if the decoder cannot go on. */
bool decoder_push(Decoder *decoder, GstBuffer *buffer);

/* Makes it give what it holds. It takes nothing any more. */
void decoder_drain(Decoder *decoder);

void decoder_close(Decoder *decoder);

#endif
