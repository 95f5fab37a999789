/* What the parts of the program share: one camera, one pipeline. */
#ifndef FARPOINT_VIDEO_H
#define FARPOINT_VIDEO_H

#include <gst/gst.h>
#include <gst/video/video.h>
#include <stdbool.h>
#include <stdint.h>

#include "rate.h"

/* Of a picture, pixels. */
enum { MOST_SIDE = 8192 };

/* How a coded picture is coded, by the code in its message; wire.ts has the same list. */
typedef enum { CODING_NONE, CODING_JPEG, CODING_PNG, CODING_H264, CODING_VP8, CODINGS } Coding;

/* Which clock's time is drawn into the picture. */
typedef enum { BARCODE_NONE, BARCODE_MONOTONIC, BARCODE_UNIX } Barcode;

/* What may change at any time; 0 is no wish. */
typedef struct {
  guint bits_per_s;
  guint frames_per_1000_s;
  /* The picture is made to fit into this. */
  guint width, height;
  Barcode barcode;
} Settings;

/* A property of the encoder that follows the settings: rate * bit/s + interval * s + frame * bits of a frame. */
typedef struct {
  char *name;
  double rate, interval, frame;
} FollowingProperty;

/* What is encoded, and by what. */
typedef struct {
  char *source, *encoder, *encoder_name, *codec, *raw_format;
  /* Elements that must exist. */
  GPtrArray *elements;
  /* FollowingProperty. */
  GArray *properties;
  guint silence_ms;
  /* The first picture is captured at a multiple of this; 0: at once. */
  guint phase_ms;
} Opening;

typedef struct {
  guint64 encoded, key_frames, bytes, encode_us, most_encode_us;
} EncodedCounts;

typedef struct {
  GMainLoop *loop;
  Opening opening;
  GstElement *pipeline, *encoder, *size_filter, *frames;
  FarpointRate *rate;

  GMutex lock;
  /* Under the lock. */
  Settings settings;
  bool changed;
  GstVideoInfo source_info;
  EncodedCounts counts;
  gint64 last_key_us;

  /* Atomic. */
  guint came, to_encoder, refused, damaged, undecoded;
} Video;

/* pipeline.c */
bool pipeline_start(Video *video);
void pipeline_configure(Video *video, const Settings *settings);
void pipeline_key_frame(Video *video);
void pipeline_stop(Video *video);

/* encoded.c */
void encoded_attach(Video *video, GstElement *sink);
/* CLOCK_MONOTONIC, ns, of a buffer on this pad; GST_CLOCK_TIME_NONE if that is not known. */
GstClockTime capture_time_at(Video *video, GstPad *pad, GstBuffer *buffer);

/* barcode.c */
void barcode_attach(Video *video);

/* size.c */
void fit_size(const GstVideoInfo *source, const Settings *settings, guint *width, guint *height);

/* frames.c: reads a `frame` message's payload. Returns false at the end of the input. */
bool frames_take(Video *video, guint32 size);
/* Takes the buffer, whose time is its capture time. For any thread. */
void frames_push(Video *video, GstBuffer *buffer, GstCaps *caps);
/* Reads past the rest of a message that makes no sense, and counts it. Returns false at the end of the input. */
bool frames_refuse(Video *video, guint32 size, const char *why);

/* decode.c: reads a `coded` message's payload. Returns false at the end of the input. */
bool decode_take(Video *video, guint32 size);

/* coded.c */
/* Whether no picture of this coding needs another. */
bool coded_alone(Coding coding);
/* Whether the bytes begin as such a picture does, with a size in range. */
bool coded_sound(Coding coding, const uint8_t *bytes, gsize size);
/* Whether a decoder can begin with this picture. */
bool coded_key(Coding coding, const uint8_t *bytes, gsize size);

/* encoders.c */
void encoders_list(void);

/* faults.c: says why nothing can be encoded any more, once, and ends the program. */
void fail(Video *video, const char *reason, const char *said, const char *detail);
void fail_by_message(Video *video, GstMessage *message);
bool has_failed(void);
void end_soon(Video *video);

#endif
