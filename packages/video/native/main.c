/*
 * farpoint-video: pictures of one camera, encoded by GStreamer in a process of its own. The messages are in wire.h;
 * packages/video/src/video-process.ts is the other side. Ends when its input ends, after an error, or on SIGTERM.
 */
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "log.h"
#include "video.h"
#include "wire.h"

enum { CONFIGURE_BYTES = 13, MOST_OPEN_BYTES = 64 * 1024 };
/* What holds on to a device or a server is given this long when the program ends. */
enum { STOP_S = 2 };
/* A key frame comes at least this often, for those who cannot ask for one. */
enum { KEY_FRAME_S = 10 };

static void on_signal(int signal) {
  if (signal == SIGALRM) _exit(1);
  alarm(STOP_S);
  wire_close();
}

static void handle_signals(void) {
  struct sigaction action = {.sa_handler = on_signal};
  sigaction(SIGTERM, &action, NULL);
  sigaction(SIGINT, &action, NULL);
  sigaction(SIGALRM, &action, NULL);
  signal(SIGPIPE, SIG_IGN);
}

static void add_property(Video *video, const char *text) {
  /* NAME:RATE:INTERVAL:FRAME */
  char **parts = g_strsplit(text, ":", 4);
  if (g_strv_length(parts) == 4) {
    const FollowingProperty property = {.name = g_strdup(parts[0]),
                                        .rate = g_ascii_strtod(parts[1], NULL),
                                        .interval = g_ascii_strtod(parts[2], NULL),
                                        .frame = g_ascii_strtod(parts[3], NULL)};
    g_array_append_val(video->opening.properties, property);
  }
  g_strfreev(parts);
}

/* KEY=VALUE, each ended by a zero byte. Returns false if something is missing. */
static bool parse_open(Video *video, const char *text, size_t size) {
  Opening *opening = &video->opening;
  opening->elements = g_ptr_array_new();
  opening->properties = g_array_new(FALSE, FALSE, sizeof(FollowingProperty));
  for (const char *at = text; at < text + size; at += strlen(at) + 1) {
    const char *equals = strchr(at, '=');
    if (equals == NULL) return false;
    char *key = g_strndup(at, (gsize)(equals - at));
    const char *value = equals + 1;
    if (strcmp(key, "source") == 0) opening->source = g_strdup(value);
    else if (strcmp(key, "encoder") == 0) opening->encoder = g_strdup(value);
    else if (strcmp(key, "name") == 0) opening->encoder_name = g_strdup(value);
    else if (strcmp(key, "codec") == 0) opening->codec = g_strdup(value);
    else if (strcmp(key, "raw") == 0) opening->raw_format = g_strdup(value);
    else if (strcmp(key, "element") == 0) g_ptr_array_add(opening->elements, g_strdup(value));
    else if (strcmp(key, "property") == 0) add_property(video, value);
    else if (strcmp(key, "phase-ms") == 0) opening->phase_ms = (guint)strtoul(value, NULL, 10);
    else if (strcmp(key, "silence-ms") == 0) opening->silence_ms = (guint)strtoul(value, NULL, 10);
    g_free(key);
  }
  return opening->source != NULL && opening->encoder != NULL && opening->encoder_name != NULL &&
         opening->codec != NULL && opening->raw_format != NULL;
}

static Settings parse_settings(const uint8_t *from) {
  return (Settings){.bits_per_s = load_u32(from),
                    .frames_per_1000_s = load_u32(from + 4),
                    .width = load_u16(from + 8),
                    .height = load_u16(from + 10),
                    .barcode = from[12] <= BARCODE_UNIX ? (Barcode)from[12] : BARCODE_NONE};
}

/* Reads one message and acts on it. Returns false at the end of the input, or if it makes no sense. */
static bool take_message(Video *video, uint8_t expected) {
  uint8_t header[HEADER_BYTES];
  if (!wire_read(header, sizeof header)) return false;
  const guint32 size = load_u32(header);
  const uint8_t type = header[4];
  if (size > MOST_MESSAGE_BYTES || (expected != 0 && type != expected)) return false;
  if (type == MESSAGE_FRAME) return frames_take(video, size);
  if (type == MESSAGE_CODED) return decode_take(video, size);
  if (size > MOST_OPEN_BYTES) return false;
  char *payload = g_malloc0(size + 1);
  bool sound = wire_read(payload, size);
  if (sound && type == MESSAGE_OPEN) {
    sound = parse_open(video, payload, size);
  } else if (sound && type == MESSAGE_CONFIGURE && size == CONFIGURE_BYTES) {
    const Settings settings = parse_settings((const uint8_t *)payload);
    pipeline_configure(video, &settings);
  } else if (sound && type == MESSAGE_KEY_FRAME) {
    pipeline_key_frame(video);
  } else if (sound) {
    log_line("error", "a message of an unknown type");
  }
  g_free(payload);
  return sound;
}

static gpointer read_messages(gpointer data) {
  Video *video = data;
  while (take_message(video, 0)) continue;
  alarm(STOP_S);
  wire_close();
  end_soon(video);
  return NULL;
}

/* Fails if no picture has come for too long. */
static void watch_silence(Video *video, guint came) {
  static guint last_came;
  static gint64 since_us;
  const gint64 now_us = g_get_monotonic_time();
  if (since_us == 0 || came != last_came) since_us = now_us;
  last_came = came;
  const guint silence_ms = video->opening.silence_ms;
  if (silence_ms == 0 || now_us - since_us < (gint64)silence_ms * 1000) return;
  char *said = g_strdup_printf("no picture for %u s", silence_ms / 1000);
  fail(video, "source-lost", said, NULL);
  g_free(said);
}

/* Each second: counts since the start, and encode times since the last time. */
static gboolean tell_stats(gpointer data) {
  Video *video = data;
  static guint64 last_encoded, last_encode_us;
  guint64 reached, skipped;
  const guint came = (guint)g_atomic_int_get(&video->came);
  farpoint_rate_counts(video->rate, &reached, &skipped);
  const guint64 to_encoder = (guint)g_atomic_int_get(&video->to_encoder);
  g_mutex_lock(&video->lock);
  const EncodedCounts counts = video->counts;
  video->counts.most_encode_us = 0;
  const gint64 last_key_us = video->last_key_us;
  g_mutex_unlock(&video->lock);
  /* At most one picture waits in each queue and one is scaled. */
  static guint64 dropped;
  const guint64 gone = came - skipped - MIN(to_encoder, came - skipped);
  dropped = MAX(dropped, gone > 3 ? gone - 3 : 0);
  const guint64 recent = counts.encoded - last_encoded;
  const double mean = recent == 0 ? 0 : (double)(counts.encode_us - last_encode_us) / (double)recent / 1000;
  last_encoded = counts.encoded;
  last_encode_us = counts.encode_us;
  GString *json = g_string_new(NULL);
  char number[2][G_ASCII_DTOSTR_BUF_SIZE];
  g_ascii_formatd(number[0], G_ASCII_DTOSTR_BUF_SIZE, "%.3f", mean);
  g_ascii_formatd(number[1], G_ASCII_DTOSTR_BUF_SIZE, "%.3f", (double)counts.most_encode_us / 1000);
  g_string_append_printf(json,
                         "{\"state\":\"stats\",\"framesIn\":%u,\"skipped\":%" G_GUINT64_FORMAT
                         ",\"dropped\":%" G_GUINT64_FORMAT ",\"encoded\":%" G_GUINT64_FORMAT
                         ",\"keyFrames\":%" G_GUINT64_FORMAT ",\"bytes\":%" G_GUINT64_FORMAT
                         ",\"refused\":%u,\"damaged\":%u,\"undecoded\":%u,\"encodeMs\":%s,\"mostEncodeMs\":%s}",
                         came, skipped, dropped, counts.encoded, counts.key_frames, counts.bytes,
                         (guint)g_atomic_int_get(&video->refused), (guint)g_atomic_int_get(&video->damaged),
                         (guint)g_atomic_int_get(&video->undecoded), number[0], number[1]);
  wire_write_json(MESSAGE_STATE, json);
  g_string_free(json, TRUE);
  if (last_key_us != 0 && g_get_monotonic_time() - last_key_us > (gint64)KEY_FRAME_S * G_USEC_PER_SEC)
    pipeline_key_frame(video);
  watch_silence(video, came);
  return G_SOURCE_CONTINUE;
}

int main(int argc, char **argv) {
  gst_init(NULL, NULL);
  log_init();
  if (argc == 2 && strcmp(argv[1], "--list-encoders") == 0) {
    encoders_list();
    return 0;
  }
  if (argc != 1) {
    fputs("farpoint-video [--list-encoders]: see docs/video.md\n", stderr);
    return 2;
  }
  wire_init();
  handle_signals();
  /* Video gives way to the program that drives the robot. */
  if (nice(5) < 0) log_line("warn", "the niceness could not be set");
  farpoint_rate_register();
  Video video = {.loop = g_main_loop_new(NULL, FALSE)};
  g_mutex_init(&video.lock);
  gst_video_info_init(&video.source_info);
  if (!take_message(&video, MESSAGE_OPEN) || !take_message(&video, MESSAGE_CONFIGURE)) return 2;
  if (pipeline_start(&video)) {
    g_thread_unref(g_thread_new("input", read_messages, &video));
    g_timeout_add_seconds(1, tell_stats, &video);
    g_main_loop_run(video.loop);
    alarm(STOP_S);
    pipeline_stop(&video);
  }
  /* Not through exit(): threads of plugins may still run. */
  _exit(has_failed() ? 1 : 0);
}
