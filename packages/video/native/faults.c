#include "video.h"

void fail(Video *video, const char *reason, const char *said, const char *detail) {
  fault_tell(video->loop, reason, said, detail);
}

static const char *reason_of(Video *video, GstMessage *message, const GError *error) {
  if (fault_is_missing_element(error)) return "no-element";
  if (fault_is_not_negotiated(message, error)) return "not-negotiated";
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
