/*
 * farpoint-sound: a microphone encoded as Opus, or a voice for a loudspeaker, by GStreamer in a process of its own. The
 * messages are in wire.h and sound.h; packages/sound/src is the other side. Ends when its input ends, after an error,
 * or on SIGTERM.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "log.h"
#include "sound.h"
#include "wire.h"

enum { CONFIGURE_BYTES = 4 };

/* KEY=VALUE, each ended by a zero byte. Returns false if something is missing. */
static bool parse_open(Sound *sound, const char *text, size_t size) {
  Opening *opening = &sound->opening;
  for (const char *at = text; at < text + size; at += strlen(at) + 1) {
    const char *equals = strchr(at, '=');
    if (equals == NULL) return false;
    char *key = g_strndup(at, (gsize)(equals - at));
    const char *value = equals + 1;
    if (strcmp(key, "pipeline") == 0) opening->pipeline = g_strdup(value);
    else if (strcmp(key, "role") == 0) opening->plays = strcmp(value, "loudspeaker") == 0;
    else if (strcmp(key, "silence-ms") == 0) opening->silence_ms = (guint)strtoul(value, NULL, 10);
    g_free(key);
  }
  return opening->pipeline != NULL;
}

/* Reads one message and acts on it. Returns false at the end of the input, or if it makes no sense. */
static bool take_message(Sound *sound, uint8_t expected) {
  uint8_t header[HEADER_BYTES];
  if (!wire_read(header, sizeof header)) return false;
  const guint32 size = load_u32(header);
  const uint8_t type = header[4];
  if (size > MOST_OPEN_BYTES || (expected != 0 && type != expected)) return false;
  uint8_t *payload = g_malloc0(size + 1);
  bool sane = wire_read(payload, size);
  if (sane && type == MESSAGE_OPEN) {
    sane = expected == MESSAGE_OPEN && parse_open(sound, (const char *)payload, size);
  } else if (sane && type == MESSAGE_CONFIGURE && size == CONFIGURE_BYTES) {
    sound->bits_per_s = load_u32(payload);
    capture_configure(sound);
  } else if (sane && type == MESSAGE_PLAY) {
    play_packet(sound, payload, size);
  } else if (sane) {
    log_line("error", "a message of an unknown type");
  }
  g_free(payload);
  return sane;
}

static gpointer read_messages(gpointer data) {
  Sound *sound = data;
  while (take_message(sound, 0)) continue;
  alarm(STOP_S);
  wire_close();
  end_soon(sound->loop);
  return NULL;
}

/* Fails if a microphone has given nothing for too long. */
static void watch_silence(Sound *sound, guint came) {
  static guint last_came;
  static gint64 since_us;
  const gint64 now_us = g_get_monotonic_time();
  if (since_us == 0 || came != last_came) since_us = now_us;
  last_came = came;
  const guint silence_ms = sound->opening.silence_ms;
  if (silence_ms == 0 || now_us - since_us < (gint64)silence_ms * 1000) return;
  char *said = g_strdup_printf("no sound for %u s", silence_ms / 1000);
  fault_tell(sound->loop, "device-lost", said, NULL);
  g_free(said);
}

/* Each second: counts since the start. */
static gboolean tell_stats(gpointer data) {
  Sound *sound = data;
  const guint came = (guint)g_atomic_int_get(&sound->came);
  g_mutex_lock(&sound->lock);
  const guint64 bytes = sound->bytes;
  g_mutex_unlock(&sound->lock);
  GString *json = g_string_new(NULL);
  g_string_append_printf(json, "{\"state\":\"stats\",\"packets\":%u,\"bytes\":%" G_GUINT64_FORMAT "}", came, bytes);
  wire_write_json(MESSAGE_STATE, json);
  g_string_free(json, TRUE);
  watch_silence(sound, came);
  return G_SOURCE_CONTINUE;
}

/* The pipeline has been started: what a loudspeaker needs to be played to. */
static void tell_started(void) {
  GString *json = g_string_new("{\"state\":\"started\"}");
  wire_write_json(MESSAGE_STATE, json);
  g_string_free(json, TRUE);
}

int main(int argc, char **argv) {
  gst_init(NULL, NULL);
  log_init();
  if (argc == 2 && strcmp(argv[1], "--version") == 0) {
    char *version = gst_version_string();
    puts(version);
    g_free(version);
    return 0;
  }
  if (argc != 1) {
    fputs("farpoint-sound [--version]: see docs/sound.md\n", stderr);
    return 2;
  }
  wire_init();
  handle_signals();
  Sound sound = {.loop = g_main_loop_new(NULL, FALSE)};
  g_mutex_init(&sound.lock);
  if (!take_message(&sound, MESSAGE_OPEN) || !take_message(&sound, MESSAGE_CONFIGURE)) return 2;
  if (pipeline_start(&sound)) {
    if (!has_failed()) tell_started();
    g_thread_unref(g_thread_new("input", read_messages, &sound));
    g_timeout_add_seconds(1, tell_stats, &sound);
    g_main_loop_run(sound.loop);
    alarm(STOP_S);
    pipeline_stop(&sound);
  }
  /* Not through exit(): threads of plugins may still run. */
  _exit(has_failed() ? 1 : 0);
}
