/* What leaves the encoder, with its capture time. */
#include <gst/app/gstappsink.h>

#include "log.h"
#include "sound.h"
#include "wire.h"

enum { HEAD_BYTES = 8 };

static GstClockTime capture_time(Sound *sound, const GstSegment *segment, GstBuffer *buffer) {
  GstClockTime running = gst_segment_to_running_time(segment, GST_FORMAT_TIME, GST_BUFFER_PTS(buffer));
  if (running == GST_CLOCK_TIME_NONE) return GST_CLOCK_TIME_NONE;
  return running + gst_element_get_base_time(sound->pipeline);
}

static GstFlowReturn on_sample(GstAppSink *sink, gpointer data) {
  Sound *sound = data;
  GstSample *sample = gst_app_sink_pull_sample(sink);
  if (sample == NULL) return GST_FLOW_EOS;
  GstBuffer *buffer = gst_sample_get_buffer(sample);
  GstClockTime capture = capture_time(sound, gst_sample_get_segment(sample), buffer);
  GstMapInfo map;
  if (capture != GST_CLOCK_TIME_NONE && gst_buffer_map(buffer, &map, GST_MAP_READ)) {
    uint8_t head[HEAD_BYTES];
    store_u64(head, capture);
    g_atomic_int_inc(&sound->came);
    g_mutex_lock(&sound->lock);
    sound->bytes += map.size;
    g_mutex_unlock(&sound->lock);
    wire_write(MESSAGE_SOUND, head, sizeof head, map.data, map.size);
    gst_buffer_unmap(buffer, &map);
  }
  gst_sample_unref(sample);
  return GST_FLOW_OK;
}

void capture_attach(Sound *sound, GstElement *sink) {
  GstAppSinkCallbacks callbacks = {.new_sample = on_sample};
  gst_app_sink_set_callbacks(GST_APP_SINK(sink), &callbacks, sound, NULL);
}

void capture_configure(Sound *sound) {
  if (sound->encoder != NULL && sound->bits_per_s > 0)
    g_object_set(sound->encoder, "bitrate", (gint)sound->bits_per_s, NULL);
}
