/* A decoder of GStreamer's, outside of the camera's pipeline: what it fails on costs a picture, and not the pipeline. */
#include "decoder.h"

#include <string.h>

#include "log.h"

typedef struct {
  /* The first that is installed; %s is its name. */
  const char *names[3], *text, *caps;
} Kind;

/* By `Coding`. With threads of their own, decoders would give each picture later. */
static const Kind kinds[CODINGS] = {
    [CODING_JPEG] = {{"jpegdec", "avdec_mjpeg"}, "%s", "image/jpeg"},
    [CODING_PNG] = {{"pngdec", "avdec_png"}, "%s", "image/png"},
    [CODING_H264] = {{"avdec_h264", "openh264dec"},
                     "h264parse ! %s",
                     "video/x-h264,stream-format=byte-stream,alignment=au"},
    [CODING_VP8] = {{"vp8dec", "avdec_vp8"}, "%s", "video/x-vp8"},
};

static const char *installed(const Kind *kind) {
  for (guint i = 0; kind->names[i] != NULL; i++) {
    GstElementFactory *factory = gst_element_factory_find(kind->names[i]);
    if (factory == NULL) continue;
    gst_object_unref(factory);
    return kind->names[i];
  }
  return NULL;
}

/* Pictures of a size that nothing here may have: the decoder does not hear of it, and so refuses them. */
static GstPadProbeReturn before_decoder(GstPad *pad, GstPadProbeInfo *info, gpointer data) {
  GstEvent *event = GST_PAD_PROBE_INFO_EVENT(info);
  if (GST_EVENT_TYPE(event) != GST_EVENT_CAPS) return GST_PAD_PROBE_OK;
  GstCaps *caps;
  gst_event_parse_caps(event, &caps);
  gint width = 0, height = 0;
  gst_structure_get_int(gst_caps_get_structure(caps, 0), "width", &width);
  gst_structure_get_int(gst_caps_get_structure(caps, 0), "height", &height);
  return width > MOST_SIDE || height > MOST_SIDE ? GST_PAD_PROBE_DROP : GST_PAD_PROBE_OK;
}

static gboolean on_event(GstPad *pad, GstObject *parent, GstEvent *event) {
  if (GST_EVENT_TYPE(event) == GST_EVENT_CAPS) {
    Decoder *decoder = gst_pad_get_element_private(pad);
    GstCaps *caps;
    gst_event_parse_caps(event, &caps);
    gst_caps_replace(&decoder->decoded_caps, caps);
  }
  gst_event_unref(event);
  return TRUE;
}

static GstFlowReturn on_decoded(GstPad *pad, GstObject *parent, GstBuffer *buffer) {
  Decoder *decoder = gst_pad_get_element_private(pad);
  if (decoder->decoded_caps != NULL) decoder->on_picture(decoder->data, buffer, decoder->decoded_caps);
  gst_buffer_unref(buffer);
  return GST_FLOW_OK;
}

static void limit_threads(GstElement *element) {
  if (g_object_class_find_property(G_OBJECT_GET_CLASS(element), "max-threads") != NULL)
    g_object_set(element, "max-threads", 1, NULL);
}

/* Both pads are the program's own, so that it pushes the pictures itself and knows when one is done with. */
static bool link_pads(Decoder *decoder, GstElement *bin, const char *caps_text) {
  GstPad *sink = gst_element_get_static_pad(bin, "sink"), *src = gst_element_get_static_pad(bin, "src");
  bool sound = sink != NULL && src != NULL;
  decoder->feed = gst_pad_new("feed", GST_PAD_SRC);
  decoder->decoded = gst_pad_new("decoded", GST_PAD_SINK);
  gst_pad_set_element_private(decoder->decoded, decoder);
  gst_pad_set_event_function(decoder->decoded, on_event);
  gst_pad_set_chain_function(decoder->decoded, on_decoded);
  gst_pad_set_active(decoder->decoded, TRUE);
  gst_pad_set_active(decoder->feed, TRUE);
  sound = sound && gst_pad_link_full(decoder->feed, sink, GST_PAD_LINK_CHECK_NOTHING) == GST_PAD_LINK_OK &&
          gst_pad_link_full(src, decoder->decoded, GST_PAD_LINK_CHECK_NOTHING) == GST_PAD_LINK_OK;
  gst_clear_object(&sink);
  gst_clear_object(&src);
  sound = sound && gst_element_set_state(decoder->pipeline, GST_STATE_PLAYING) != GST_STATE_CHANGE_FAILURE;
  GstCaps *caps = gst_caps_from_string(caps_text);
  GstSegment segment;
  gst_segment_init(&segment, GST_FORMAT_TIME);
  sound = sound && gst_pad_push_event(decoder->feed, gst_event_new_stream_start("farpoint")) &&
          gst_pad_push_event(decoder->feed, gst_event_new_caps(caps)) &&
          gst_pad_push_event(decoder->feed, gst_event_new_segment(&segment));
  gst_caps_unref(caps);
  return sound;
}

char *decoder_open(Decoder *decoder, Coding coding) {
  decoder_close(decoder);
  const Kind *kind = &kinds[coding];
  const char *name = installed(kind);
  if (name == NULL) return g_strdup_printf("GStreamer has neither %s nor %s", kind->names[0], kind->names[1]);
  char *named = g_strdup_printf("%s name=farpoint-decoder", name), *text = g_strdup_printf(kind->text, named);
  GError *error = NULL;
  GstElement *bin = gst_parse_bin_from_description(text, TRUE, &error);
  g_free(named);
  g_free(text);
  if (bin == NULL) {
    char *said = g_strdup(error == NULL ? name : error->message);
    g_clear_error(&error);
    return said;
  }
  g_clear_error(&error);
  decoder->pipeline = gst_object_ref_sink(gst_pipeline_new(NULL));
  gst_bin_add(GST_BIN(decoder->pipeline), bin);
  GstElement *element = gst_bin_get_by_name(GST_BIN(bin), "farpoint-decoder");
  limit_threads(element);
  GstPad *pad = gst_element_get_static_pad(element, "sink");
  gst_pad_add_probe(pad, GST_PAD_PROBE_TYPE_EVENT_DOWNSTREAM, before_decoder, NULL, NULL);
  gst_object_unref(pad);
  gst_object_unref(element);
  if (!link_pads(decoder, bin, kind->caps)) {
    decoder_close(decoder);
    return g_strdup_printf("%s cannot be started", name);
  }
  decoder->coding = coding;
  return NULL;
}

/* What it says is read, because it would pile up. */
static void read_messages(Decoder *decoder) {
  GstBus *bus = gst_element_get_bus(decoder->pipeline);
  for (GstMessage *message; (message = gst_bus_pop(bus)) != NULL; gst_message_unref(message)) {
    if (GST_MESSAGE_TYPE(message) != GST_MESSAGE_ERROR) continue;
    GError *error = NULL;
    gst_message_parse_error(message, &error, NULL);
    log_line("debug", error->message);
    g_error_free(error);
  }
  gst_object_unref(bus);
}

bool decoder_push(Decoder *decoder, GstBuffer *buffer) {
  const GstFlowReturn flow = gst_pad_push(decoder->feed, buffer);
  read_messages(decoder);
  return flow == GST_FLOW_OK;
}

void decoder_drain(Decoder *decoder) {
  if (decoder->feed != NULL) gst_pad_push_event(decoder->feed, gst_event_new_eos());
}

void decoder_close(Decoder *decoder) {
  if (decoder->pipeline != NULL) gst_element_set_state(decoder->pipeline, GST_STATE_NULL);
  if (decoder->feed != NULL) gst_pad_set_active(decoder->feed, FALSE);
  if (decoder->decoded != NULL) gst_pad_set_active(decoder->decoded, FALSE);
  gst_clear_object(&decoder->pipeline);
  gst_clear_object(&decoder->feed);
  gst_clear_object(&decoder->decoded);
  gst_clear_caps(&decoder->decoded_caps);
  decoder->coding = CODING_NONE;
}
