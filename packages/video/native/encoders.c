/* `farpoint-video --list-encoders`: the encoders that GStreamer finds on this machine, as JSON. */
#include <stdio.h>

#include "log.h"
#include "video.h"

static bool first = true;

static void list(GString *json, GList *all, const char *codec, const char *media_type) {
  GstCaps *caps = gst_caps_new_empty_simple(media_type);
  GList *made = gst_element_factory_list_filter(all, caps, GST_PAD_SRC, FALSE);
  for (GList *each = made; each != NULL; each = each->next) {
    g_string_append(json, first ? "{\"name\":" : ",{\"name\":");
    first = false;
    json_string(json, GST_OBJECT_NAME(each->data));
    g_string_append_printf(json, ",\"codec\":\"%s\"}", codec);
  }
  gst_plugin_feature_list_free(made);
  gst_caps_unref(caps);
}

void encoders_list(void) {
  guint major, minor, micro, nano;
  gst_version(&major, &minor, &micro, &nano);
  GString *json = g_string_new(NULL);
  g_string_append_printf(json, "{\"gstreamer\":\"%u.%u.%u\",\"encoders\":[", major, minor, micro);
  GList *all = gst_element_factory_list_get_elements(GST_ELEMENT_FACTORY_TYPE_VIDEO_ENCODER, GST_RANK_NONE);
  list(json, all, "h264", "video/x-h264");
  list(json, all, "vp8", "video/x-vp8");
  gst_plugin_feature_list_free(all);
  g_string_append(json, "]}");
  puts(json->str);
  g_string_free(json, TRUE);
}
