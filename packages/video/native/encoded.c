/* What leaves the encoder, with its capture time and with how long the encoder took for it. */
#include <gst/app/gstappsink.h>

#include "log.h"
#include "video.h"
#include "wire.h"

enum { HEAD_BYTES = 17, KEY_FLAG = 1 };

/* When each picture entered the encoder, by its capture time. Encoders hold a few pictures at most. */
enum { ENTRIES = 32 };
static struct {
  GstClockTime capture;
  gint64 entered_us;
} entries[ENTRIES];
static guint next_entry;
static GMutex entries_lock;

/* Size last told; only the thread of the encoder uses it. */
static gint told_width, told_height;

static GstClockTime capture_time(Video *video, const GstSegment *segment, GstBuffer *buffer) {
  GstClockTime running = gst_segment_to_running_time(segment, GST_FORMAT_TIME, GST_BUFFER_PTS(buffer));
  if (running == GST_CLOCK_TIME_NONE) return GST_CLOCK_TIME_NONE;
  return running + gst_element_get_base_time(video->pipeline);
}

GstClockTime capture_time_at(Video *video, GstPad *pad, GstBuffer *buffer) {
  GstEvent *event = gst_pad_get_sticky_event(pad, GST_EVENT_SEGMENT, 0);
  if (event == NULL) return GST_CLOCK_TIME_NONE;
  const GstSegment *segment;
  gst_event_parse_segment(event, &segment);
  GstClockTime result = capture_time(video, segment, buffer);
  gst_event_unref(event);
  return result;
}

static GstPadProbeReturn on_enter(GstPad *pad, GstPadProbeInfo *info, gpointer data) {
  Video *video = data;
  const GstClockTime capture = capture_time_at(video, pad, GST_PAD_PROBE_INFO_BUFFER(info));
  g_atomic_int_inc(&video->to_encoder);
  g_mutex_lock(&entries_lock);
  entries[next_entry].capture = capture;
  entries[next_entry].entered_us = g_get_monotonic_time();
  next_entry = (next_entry + 1) % ENTRIES;
  g_mutex_unlock(&entries_lock);
  return GST_PAD_PROBE_OK;
}

/* Microseconds since the picture entered the encoder; 0 if that is not known. */
static guint64 encode_time(GstClockTime capture) {
  guint64 result = 0;
  g_mutex_lock(&entries_lock);
  for (guint i = 0; i < ENTRIES; i++)
    if (entries[i].capture == capture) result = (guint64)(g_get_monotonic_time() - entries[i].entered_us);
  g_mutex_unlock(&entries_lock);
  return result;
}

static void tell_playing(Video *video, gint width, gint height) {
  if (width == told_width && height == told_height) return;
  told_width = width;
  told_height = height;
  g_mutex_lock(&video->lock);
  const GstVideoInfo source = video->source_info;
  g_mutex_unlock(&video->lock);
  GString *json = g_string_new("{\"state\":\"playing\",\"codec\":");
  json_string(json, video->opening.codec);
  g_string_append(json, ",\"encoder\":");
  json_string(json, video->opening.encoder_name);
  g_string_append_printf(json, ",\"width\":%d,\"height\":%d,\"sourceWidth\":%d,\"sourceHeight\":%d}", width, height,
                         GST_VIDEO_INFO_WIDTH(&source), GST_VIDEO_INFO_HEIGHT(&source));
  wire_write_json(MESSAGE_STATE, json);
  g_string_free(json, TRUE);
}

static GstFlowReturn on_sample(GstAppSink *sink, gpointer data) {
  Video *video = data;
  GstSample *sample = gst_app_sink_pull_sample(sink);
  if (sample == NULL) return GST_FLOW_EOS;
  GstBuffer *buffer = gst_sample_get_buffer(sample);
  const GstStructure *caps = gst_caps_get_structure(gst_sample_get_caps(sample), 0);
  gint width = 0, height = 0;
  gst_structure_get_int(caps, "width", &width);
  gst_structure_get_int(caps, "height", &height);
  GstClockTime capture = capture_time(video, gst_sample_get_segment(sample), buffer);
  GstMapInfo map;
  if (capture != GST_CLOCK_TIME_NONE && gst_buffer_map(buffer, &map, GST_MAP_READ)) {
    const bool key = !GST_BUFFER_FLAG_IS_SET(buffer, GST_BUFFER_FLAG_DELTA_UNIT);
    const guint64 took = encode_time(capture);
    tell_playing(video, width, height);
    uint8_t head[HEAD_BYTES];
    store_u64(head, capture);
    head[8] = key ? KEY_FLAG : 0;
    store_u16(head + 9, (uint16_t)width);
    store_u16(head + 11, (uint16_t)height);
    store_u32(head + 13, (uint32_t)MIN(took, G_MAXUINT32));
    g_mutex_lock(&video->lock);
    video->counts.encoded++;
    video->counts.key_frames += key;
    video->counts.bytes += map.size;
    video->counts.encode_us += took;
    video->counts.most_encode_us = MAX(video->counts.most_encode_us, took);
    if (key) video->last_key_us = g_get_monotonic_time();
    g_mutex_unlock(&video->lock);
    wire_write(MESSAGE_ENCODED, head, sizeof head, map.data, map.size);
    gst_buffer_unmap(buffer, &map);
  }
  gst_sample_unref(sample);
  return GST_FLOW_OK;
}

void encoded_attach(Video *video, GstElement *sink) {
  GstAppSinkCallbacks callbacks = {.new_sample = on_sample};
  gst_app_sink_set_callbacks(GST_APP_SINK(sink), &callbacks, video, NULL);
  GstPad *pad = gst_element_get_static_pad(video->encoder, "sink");
  gst_pad_add_probe(pad, GST_PAD_PROBE_TYPE_BUFFER, on_enter, video, NULL);
  gst_object_unref(pad);
}
