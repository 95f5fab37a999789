/* What goes to the decoder. An empty packet is one that was lost: the decoder conceals it. */
#include <gst/app/gstappsrc.h>

#include "log.h"
#include "sound.h"
#include "wire.h"

enum { HEAD_BYTES = 12 };

void play_packet(Sound *sound, const uint8_t *payload, gsize size) {
  if (sound->packets == NULL || size < HEAD_BYTES) return;
  const GstClockTime base = gst_element_get_base_time(sound->pipeline), heard = load_u64(payload);
  /* Before the pipeline runs, and what should have been heard before it ran. */
  if (base == GST_CLOCK_TIME_NONE || heard < base) return;
  GstBuffer *buffer =
      size == HEAD_BYTES ? gst_buffer_new() : gst_buffer_new_memdup(payload + HEAD_BYTES, size - HEAD_BYTES);
  GST_BUFFER_PTS(buffer) = heard - base;
  GST_BUFFER_DURATION(buffer) = load_u32(payload + 8) * GST_USECOND;
  g_atomic_int_inc(&sound->came);
  /* Takes the buffer. A full queue drops its oldest. */
  gst_app_src_push_buffer(GST_APP_SRC(sound->packets), buffer);
}
