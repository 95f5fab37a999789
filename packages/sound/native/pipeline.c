#include "log.h"
#include "sound.h"
#include "wire.h"

static const char *reason_of(Sound *sound, GstMessage *message, const GError *error) {
  if (fault_is_missing_element(error)) return "no-element";
  if (fault_is_not_negotiated(message, error)) return "not-negotiated";
  if (sound->encoder != NULL && GST_MESSAGE_SRC(message) == GST_OBJECT(sound->encoder)) return "codec-failed";
  return "device-lost";
}

static gboolean on_message(GstBus *bus, GstMessage *message, gpointer data) {
  Sound *sound = data;
  GError *error = NULL;
  gchar *debug = NULL;
  if (GST_MESSAGE_TYPE(message) == GST_MESSAGE_ERROR) {
    gst_message_parse_error(message, &error, &debug);
    char *said = g_strdup_printf("%s: %s", GST_MESSAGE_SRC_NAME(message), error->message);
    fault_tell(sound->loop, reason_of(sound, message, error), said, debug);
    g_free(said);
  } else if (GST_MESSAGE_TYPE(message) == GST_MESSAGE_EOS) {
    fault_tell(sound->loop, "device-lost", "the source has ended", NULL);
  } else if (GST_MESSAGE_TYPE(message) == GST_MESSAGE_WARNING) {
    gst_message_parse_warning(message, &error, NULL);
    log_line("warn", error->message);
  }
  g_free(debug);
  g_clear_error(&error);
  return G_SOURCE_CONTINUE;
}

static bool build(Sound *sound) {
  GError *error = NULL;
  sound->pipeline = gst_parse_launch_full(sound->opening.pipeline, NULL, GST_PARSE_FLAG_FATAL_ERRORS, &error);
  if (sound->pipeline != NULL && !GST_IS_PIPELINE(sound->pipeline)) gst_clear_object(&sound->pipeline);
  if (error != NULL || sound->pipeline == NULL) {
    const bool missing = g_error_matches(error, GST_PARSE_ERROR, GST_PARSE_ERROR_NO_SUCH_ELEMENT);
    fault_tell(sound->loop, missing ? "no-element" : "parse", error == NULL ? "it is no pipeline" : error->message,
               NULL);
    return false;
  }
  GstBin *bin = GST_BIN(sound->pipeline);
  sound->encoder = gst_bin_get_by_name(bin, "farpoint-encoder");
  sound->packets = gst_bin_get_by_name(bin, "farpoint-packets");
  GstElement *out = gst_bin_get_by_name(bin, "farpoint-out");
  if (out != NULL) capture_attach(sound, out);
  return true;
}

/* Whether what comes before the element is captured now. */
static bool is_live(GstElement *element) {
  GstPad *pad = gst_element_get_static_pad(element, "sink");
  GstQuery *query = gst_query_new_latency();
  gboolean live = FALSE;
  if (gst_pad_peer_query(pad, query)) gst_query_parse_latency(query, &live, NULL, NULL);
  gst_query_unref(query);
  gst_object_unref(pad);
  return live;
}

bool pipeline_start(Sound *sound) {
  if (!build(sound)) return false;
  capture_configure(sound);
  GstBus *bus = gst_element_get_bus(sound->pipeline);
  gst_bus_add_watch(bus, on_message, sound);
  gst_object_unref(bus);
  /* CLOCK_MONOTONIC, whatever clock the device would have: capture times and times to be heard are on it. */
  GstClock *clock = gst_system_clock_obtain();
  gst_pipeline_use_clock(GST_PIPELINE(sound->pipeline), clock);
  gst_object_unref(clock);
  gst_element_set_state(sound->pipeline, GST_STATE_PAUSED);
  /* A file would be read as fast as it can be. A device keeps its own pace, and is not to be delayed. */
  GstElement *pace = gst_bin_get_by_name(GST_BIN(sound->pipeline), "farpoint-pace");
  if (pace != NULL && is_live(pace)) g_object_set(pace, "sync", FALSE, NULL);
  /* What goes wrong is on the bus. */
  gst_element_set_state(sound->pipeline, GST_STATE_PLAYING);
  return true;
}

void pipeline_stop(Sound *sound) {
  if (sound->pipeline != NULL) gst_element_set_state(sound->pipeline, GST_STATE_NULL);
}
