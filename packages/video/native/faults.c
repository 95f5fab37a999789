#include <string.h>

#include "log.h"
#include "video.h"
#include "wire.h"

static gint failed;

static gboolean quit(gpointer loop) {
  g_main_loop_quit(loop);
  return G_SOURCE_REMOVE;
}

/* By the loop itself, because it may not run yet. */
void end_soon(Video *video) { g_idle_add(quit, video->loop); }

bool has_failed(void) { return g_atomic_int_get(&failed) != 0; }

void fail(Video *video, const char *reason, const char *said, const char *detail) {
  if (!g_atomic_int_compare_and_exchange(&failed, 0, 1)) return;
  GString *json = g_string_new("{\"reason\":");
  json_string(json, reason);
  g_string_append(json, ",\"said\":");
  json_string(json, said);
  g_string_append(json, ",\"detail\":");
  json_string(json, detail);
  g_string_append_c(json, '}');
  wire_write_json(MESSAGE_ERROR, json);
  g_string_free(json, TRUE);
  end_soon(video);
}

static bool is_not_negotiated(GstMessage *message, const GError *error) {
  if (g_error_matches(error, GST_CORE_ERROR, GST_CORE_ERROR_NEGOTIATION) ||
      g_error_matches(error, GST_CORE_ERROR, GST_CORE_ERROR_CAPS) ||
      g_error_matches(error, GST_STREAM_ERROR, GST_STREAM_ERROR_FORMAT) ||
      g_error_matches(error, GST_STREAM_ERROR, GST_STREAM_ERROR_WRONG_TYPE))
    return true;
  const GstStructure *details = NULL;
  gint flow = GST_FLOW_OK;
  gst_message_parse_error_details(message, &details);
  return details != NULL && gst_structure_get_int(details, "flow-return", &flow) &&
         flow == GST_FLOW_NOT_NEGOTIATED;
}

static const char *reason_of(Video *video, GstMessage *message, const GError *error) {
  if (g_error_matches(error, GST_CORE_ERROR, GST_CORE_ERROR_MISSING_PLUGIN) ||
      g_error_matches(error, GST_STREAM_ERROR, GST_STREAM_ERROR_CODEC_NOT_FOUND))
    return "no-element";
  if (is_not_negotiated(message, error)) return "not-negotiated";
  GstObject *source = GST_MESSAGE_SRC(message);
  if (source == GST_OBJECT(video->encoder) || gst_object_has_as_ancestor(source, GST_OBJECT(video->encoder)))
    return "encoder-failed";
  return "source-lost";
}

void fail_by_message(Video *video, GstMessage *message) {
  GError *error = NULL;
  gchar *debug = NULL;
  gst_message_parse_error(message, &error, &debug);
  char *said = g_strdup_printf("%s: %s", GST_MESSAGE_SRC_NAME(message), error->message);
  fail(video, reason_of(video, message, error), said, debug);
  g_free(said);
  g_free(debug);
  g_error_free(error);
}
