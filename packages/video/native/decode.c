/*
 * Coded pictures from the input, decoded in a thread of their own and then treated as raw ones. Pictures that need no
 * other: one waits, and a newer one takes its place. Of others, a few wait; where they are too many, or one is missing,
 * all are left out until the next that needs none before it.
 */
#include "decoder.h"
#include "log.h"
#include "video.h"
#include "wire.h"

enum { HEAD_BYTES = 10, LOST_FLAG = 1, MOST_WAITING = 8 };

typedef struct {
  Coding coding;
  bool key;
  GstBuffer *buffer;
} Picture;

static GMutex lock;
static GCond arrived;
/* Under the lock. */
static GQueue waiting = G_QUEUE_INIT;
static Coding last_coding;
static bool key_needed = true;

/* Capture times of the pictures that the decoder has, oldest first. Only its thread uses them. */
static GstClockTime inside[64];
static guint inside_count;

static void count_damaged(Video *video, guint pictures) {
  if (pictures > 0 && g_atomic_int_add(&video->damaged, pictures) == 0)
    log_line("warn", "a coded picture is damaged, and is left out");
}

static void free_picture(gpointer data) {
  gst_buffer_unref(((Picture *)data)->buffer);
  g_free(data);
}

/* All, or those before the first that a decoder can begin with. Under the lock. */
static void drop_waiting(Video *video, bool all) {
  for (Picture *next; (next = g_queue_peek_head(&waiting)) != NULL && (all || !next->key);) {
    free_picture(g_queue_pop_head(&waiting));
    g_atomic_int_inc(&video->undecoded);
  }
}

static void forget_before(Video *video, GstClockTime capture) {
  guint kept = 0, lost = 0;
  for (guint i = 0; i < inside_count; i++) {
    if (inside[i] > capture) inside[kept++] = inside[i];
    else lost += inside[i] < capture;
  }
  inside_count = kept;
  /* Decoders give pictures in the order of their capture: what is older than one of them does not come any more. */
  count_damaged(video, lost);
}

static void on_picture(gpointer data, GstBuffer *buffer, GstCaps *caps) {
  Video *video = data;
  if (!GST_BUFFER_PTS_IS_VALID(buffer)) return;
  forget_before(video, GST_BUFFER_PTS(buffer));
  frames_push(video, gst_buffer_ref(buffer), caps);
}

static void need_key(Video *video) {
  g_mutex_lock(&lock);
  drop_waiting(video, false);
  if (g_queue_is_empty(&waiting)) key_needed = true;
  g_mutex_unlock(&lock);
}

/* What the decoder has not given by now is damaged. What it keeps of that would spoil the next picture, so it ends. */
static void end_decoder(Video *video, Decoder *decoder) {
  decoder_drain(decoder);
  decoder_close(decoder);
  count_damaged(video, inside_count);
  inside_count = 0;
}

static bool begin_decoder(Video *video, Decoder *decoder, Coding coding) {
  end_decoder(video, decoder);
  char *said = decoder_open(decoder, coding);
  if (said == NULL) return true;
  fail(video, "no-element", said, NULL);
  g_free(said);
  return false;
}

/* Returns false if nothing can come of the picture. */
static bool give(Video *video, Decoder *decoder, const Picture *picture) {
  if (inside_count == G_N_ELEMENTS(inside)) forget_before(video, inside[inside_count / 2]);
  inside[inside_count++] = GST_BUFFER_PTS(picture->buffer);
  const bool goes_on = decoder_push(decoder, gst_buffer_ref(picture->buffer));
  return goes_on && !(coded_alone(picture->coding) && inside_count > 0);
}

/* Returns false if there is no such decoder. */
static bool decode_one(Video *video, Decoder *decoder, const Picture *picture) {
  const bool fresh = decoder->coding != picture->coding || (picture->key && inside_count > 0);
  if (fresh && !begin_decoder(video, decoder, picture->coding)) return false;
  if (give(video, decoder, picture)) return true;
  if (picture->key && !fresh) {
    /* Perhaps the one before it was damaged, and has spoiled the decoder. */
    if (inside_count > 0) inside_count--;
    if (!begin_decoder(video, decoder, picture->coding)) return false;
    if (give(video, decoder, picture)) return true;
  }
  end_decoder(video, decoder);
  if (!coded_alone(picture->coding)) need_key(video);
  return true;
}

static gpointer decode(gpointer data) {
  Video *video = data;
  Decoder decoder = {.on_picture = on_picture, .data = video};
  for (bool goes_on = true; goes_on;) {
    g_mutex_lock(&lock);
    while (g_queue_is_empty(&waiting)) g_cond_wait(&arrived, &lock);
    Picture *picture = g_queue_pop_head(&waiting);
    g_mutex_unlock(&lock);
    goes_on = decode_one(video, &decoder, picture);
    free_picture(picture);
  }
  return NULL;
}

/* Whether the picture may wait for the decoder; makes room for it. Under the lock. */
static bool may_wait(Video *video, Coding coding, bool key, bool lost) {
  if (coding != last_coding || lost) {
    key_needed = true;
    last_coding = coding;
  }
  if (coded_alone(coding)) drop_waiting(video, true);
  else if (g_queue_get_length(&waiting) >= MOST_WAITING) {
    if (key) drop_waiting(video, true);
    else key_needed = true;
  }
  if (key) key_needed = false;
  return !key_needed;
}

static void take(Video *video, Coding coding, GstBuffer *buffer, bool key, bool lost) {
  static bool started;
  if (!started) g_thread_unref(g_thread_new("decoder", decode, video));
  started = true;
  g_mutex_lock(&lock);
  if (may_wait(video, coding, key, lost)) {
    Picture *picture = g_new(Picture, 1);
    *picture = (Picture){.coding = coding, .key = key, .buffer = buffer};
    g_queue_push_tail(&waiting, picture);
    g_cond_signal(&arrived);
  } else {
    g_atomic_int_inc(&video->undecoded);
    gst_buffer_unref(buffer);
  }
  g_mutex_unlock(&lock);
}

static void take_none(void) {
  g_mutex_lock(&lock);
  key_needed = true;
  g_mutex_unlock(&lock);
}

bool decode_take(Video *video, guint32 size) {
  uint8_t head[HEAD_BYTES];
  if (size <= HEAD_BYTES) return frames_refuse(video, size, "a coded picture's message is too short");
  if (!wire_read(head, sizeof head)) return false;
  const guint32 rest = size - HEAD_BYTES;
  const Coding coding = head[8] < CODINGS ? (Coding)head[8] : CODING_NONE;
  if (video->frames == NULL) return frames_refuse(video, rest, "a coded picture came, but the source is another one");
  if (coding == CODING_NONE) return frames_refuse(video, rest, "a coded picture's coding is unknown");
  if (rest > MOST_CODED_BYTES) return frames_refuse(video, rest, "a coded picture has too many bytes");
  GstBuffer *buffer = gst_buffer_new_allocate(NULL, rest, NULL);
  GstMapInfo map;
  gst_buffer_map(buffer, &map, GST_MAP_WRITE);
  const bool complete = wire_read(map.data, rest);
  const bool sound = complete && coded_sound(coding, map.data, rest);
  const bool key = sound && coded_key(coding, map.data, rest);
  gst_buffer_unmap(buffer, &map);
  GST_BUFFER_PTS(buffer) = load_u64(head);
  if (sound) {
    take(video, coding, buffer, key, (head[9] & LOST_FLAG) != 0);
    return true;
  }
  gst_buffer_unref(buffer);
  if (complete) count_damaged(video, 1);
  /* What was missing for the decoder is missing for those after it, too. */
  if (complete) take_none();
  return complete;
}
