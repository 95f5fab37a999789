/*
 *  SOURCE ! clocksync ! queue, one picture, newest wins ! farpointrate ! videoscale ! videoconvert ! size and format
 *         ! queue, one picture, newest wins ! ENCODER ! appsink
 */
#include "log.h"
#include "video.h"

/* One picture waits, and a newer one takes its place. */
#define ONE_PICTURE "leaky=downstream max-size-buffers=1 max-size-bytes=0 max-size-time=0"
#define TEXT                                                                                                     \
  "%s ! clocksync name=farpoint-pace sync=false ! queue name=farpoint-head " ONE_PICTURE                         \
  " ! farpointrate name=farpoint-rate ! videoscale add-borders=false ! videoconvert"                             \
  " ! capsfilter name=farpoint-size ! queue name=farpoint-wait " ONE_PICTURE                                     \
  " ! %s ! appsink name=farpoint-out sync=false async=false max-buffers=1 enable-last-sample=false"

static void set_number(GObject *object, const char *name, double value) {
  GParamSpec *spec = g_object_class_find_property(G_OBJECT_GET_CLASS(object), name);
  if (G_IS_PARAM_SPEC_UINT(spec)) {
    const GParamSpecUInt *range = G_PARAM_SPEC_UINT(spec);
    g_object_set(object, name, (guint)CLAMP(value, range->minimum, range->maximum), NULL);
  } else if (G_IS_PARAM_SPEC_INT(spec)) {
    const GParamSpecInt *range = G_PARAM_SPEC_INT(spec);
    g_object_set(object, name, (gint)CLAMP(value, range->minimum, range->maximum), NULL);
  } else {
    log_line("warn", "the encoder lacks a property that sets its rate");
  }
}

/* From one picture to the next, as far as that is known. */
static double interval_s(const GstVideoInfo *source, const Settings *settings) {
  const double wanted = settings->frames_per_1000_s == 0 ? 0 : 1000.0 / settings->frames_per_1000_s;
  const gint n = GST_VIDEO_INFO_FPS_N(source), d = GST_VIDEO_INFO_FPS_D(source);
  const double given = n > 0 && d > 0 ? (double)d / n : 0;
  const double longer = MAX(wanted, given);
  return longer > 0 ? longer : 1.0 / 30;
}

/* The encoder's properties that follow the bit rate and the rate of pictures. */
static void set_following(Video *video, const GstVideoInfo *source, const Settings *settings) {
  const double seconds = interval_s(source, settings);
  for (guint i = 0; i < video->opening.properties->len; i++) {
    const FollowingProperty *each = &g_array_index(video->opening.properties, FollowingProperty, i);
    const double value = each->rate * settings->bits_per_s + each->interval * seconds +
                         each->frame * settings->bits_per_s * seconds;
    set_number(G_OBJECT(video->encoder), each->name, value + 0.5);
  }
}

/* Sets size and rate. Called by the thread that scales, so that no picture is under way with the old ones. */
static void set_shape(Video *video, const GstVideoInfo *source, const Settings *settings) {
  if (GST_VIDEO_INFO_WIDTH(source) > 0) {
    guint width, height;
    fit_size(source, settings, &width, &height);
    char *text = g_strdup_printf("video/x-raw,%s,width=%u,height=%u,pixel-aspect-ratio=1/1",
                                 video->opening.raw_format, width, height);
    GstCaps *caps = gst_caps_from_string(text);
    g_object_set(video->size_filter, "caps", caps, NULL);
    gst_caps_unref(caps);
    g_free(text);
  }
  farpoint_rate_want(video->rate, settings->frames_per_1000_s);
  set_following(video, source, settings);
}

/* In front of the rate element: applies new settings, and the size that follows from the source's. */
static GstPadProbeReturn before_rate(GstPad *pad, GstPadProbeInfo *info, gpointer data) {
  Video *video = data;
  g_mutex_lock(&video->lock);
  bool changed = video->changed;
  if (GST_PAD_PROBE_INFO_TYPE(info) & GST_PAD_PROBE_TYPE_EVENT_DOWNSTREAM) {
    GstEvent *event = GST_PAD_PROBE_INFO_EVENT(info);
    GstCaps *caps;
    changed = GST_EVENT_TYPE(event) == GST_EVENT_CAPS;
    if (changed) gst_event_parse_caps(event, &caps);
    changed = changed && gst_video_info_from_caps(&video->source_info, caps);
  }
  const Settings settings = video->settings;
  const GstVideoInfo source = video->source_info;
  if (changed) video->changed = false;
  g_mutex_unlock(&video->lock);
  if (changed) set_shape(video, &source, &settings);
  return GST_PAD_PROBE_OK;
}

static GstPadProbeReturn on_came(GstPad *pad, GstPadProbeInfo *info, gpointer data) {
  g_atomic_int_inc(&((Video *)data)->came);
  return GST_PAD_PROBE_OK;
}

/*
 * A new size is made here, not by the source: told to negotiate anew, a camera would stop and start, or on older kernels
 * find itself busy.
 */
static GstPadProbeReturn to_source(GstPad *pad, GstPadProbeInfo *info, gpointer data) {
  return GST_EVENT_TYPE(GST_PAD_PROBE_INFO_EVENT(info)) == GST_EVENT_RECONFIGURE ? GST_PAD_PROBE_DROP : GST_PAD_PROBE_OK;
}

static gboolean on_message(GstBus *bus, GstMessage *message, gpointer data) {
  Video *video = data;
  if (GST_MESSAGE_TYPE(message) == GST_MESSAGE_ERROR) {
    fail_by_message(video, message);
  } else if (GST_MESSAGE_TYPE(message) == GST_MESSAGE_EOS) {
    fail(video, "source-lost", "the source has ended", NULL);
  } else if (GST_MESSAGE_TYPE(message) == GST_MESSAGE_WARNING) {
    GError *error = NULL;
    gst_message_parse_warning(message, &error, NULL);
    log_line("warn", error->message);
    g_error_free(error);
  }
  return G_SOURCE_CONTINUE;
}

static void probe(Video *video, GstElement *element, GstPadProbeType type, GstPadProbeCallback callback) {
  GstPad *pad = gst_element_get_static_pad(element, "sink");
  gst_pad_add_probe(pad, type, callback, video, NULL);
  gst_object_unref(pad);
}

static bool build(Video *video) {
  const Opening *opening = &video->opening;
  for (guint i = 0; i < opening->elements->len; i++) {
    const char *name = g_ptr_array_index(opening->elements, i);
    GstElementFactory *factory = gst_element_factory_find(name);
    if (factory == NULL) {
      char *said = g_strdup_printf("GStreamer has no element %s", name);
      fail(video, "no-encoder", said, NULL);
      g_free(said);
      return false;
    }
    gst_object_unref(factory);
  }
  /* The encoder alone at first, so that its faults are told from the source's. */
  GError *error = NULL;
  char *encoder = g_strdup_printf("%s ! identity", opening->encoder);
  GstElement *alone = gst_parse_launch_full(encoder, NULL, GST_PARSE_FLAG_FATAL_ERRORS, &error);
  g_free(encoder);
  if (error != NULL) {
    fail(video, "encoder-failed", error->message, NULL);
    return false;
  }
  gst_object_unref(alone);
  char *text = g_strdup_printf(TEXT, opening->source, opening->encoder);
  video->pipeline = gst_parse_launch_full(text, NULL, GST_PARSE_FLAG_FATAL_ERRORS, &error);
  g_free(text);
  if (video->pipeline != NULL && !GST_IS_PIPELINE(video->pipeline)) gst_clear_object(&video->pipeline);
  if (error != NULL || video->pipeline == NULL) {
    const bool missing = g_error_matches(error, GST_PARSE_ERROR, GST_PARSE_ERROR_NO_SUCH_ELEMENT);
    fail(video, missing ? "no-element" : "parse", error == NULL ? "it is no pipeline" : error->message, NULL);
    return false;
  }
  GstBin *bin = GST_BIN(video->pipeline);
  video->encoder = gst_bin_get_by_name(bin, "farpoint-encoder");
  video->size_filter = gst_bin_get_by_name(bin, "farpoint-size");
  video->rate = FARPOINT_RATE(gst_bin_get_by_name(bin, "farpoint-rate"));
  video->frames = gst_bin_get_by_name(bin, "farpoint-frames");
  return true;
}

bool pipeline_start(Video *video) {
  if (!build(video)) return false;
  GstBin *bin = GST_BIN(video->pipeline);
  probe(video, gst_bin_get_by_name(bin, "farpoint-pace"), GST_PAD_PROBE_TYPE_EVENT_UPSTREAM, to_source);
  probe(video, gst_bin_get_by_name(bin, "farpoint-head"), GST_PAD_PROBE_TYPE_BUFFER, on_came);
  probe(video, GST_ELEMENT(video->rate), GST_PAD_PROBE_TYPE_BUFFER | GST_PAD_PROBE_TYPE_EVENT_DOWNSTREAM, before_rate);
  barcode_attach(video);
  encoded_attach(video, gst_bin_get_by_name(bin, "farpoint-out"));
  set_following(video, &video->source_info, &video->settings);
  GstBus *bus = gst_element_get_bus(video->pipeline);
  gst_bus_add_watch(bus, on_message, video);
  gst_object_unref(bus);
  /* CLOCK_MONOTONIC, whatever clock the source would have. */
  GstClock *clock = gst_system_clock_obtain();
  gst_pipeline_use_clock(GST_PIPELINE(video->pipeline), clock);
  const GstClockTime now = gst_clock_get_time(clock), phase = video->opening.phase_ms * GST_MSECOND;
  gst_object_unref(clock);
  if (video->frames != NULL || phase > 0) {
    gst_element_set_start_time(video->pipeline, GST_CLOCK_TIME_NONE);
    gst_element_set_base_time(video->pipeline, phase == 0 ? 0 : (now / phase + 1) * phase);
  }
  const bool live = gst_element_set_state(video->pipeline, GST_STATE_PAUSED) == GST_STATE_CHANGE_NO_PREROLL;
  /* A file would be read as fast as it can be. */
  if (!live && video->frames == NULL) g_object_set(gst_bin_get_by_name(bin, "farpoint-pace"), "sync", TRUE, NULL);
  /* What goes wrong is on the bus. */
  gst_element_set_state(video->pipeline, GST_STATE_PLAYING);
  return true;
}

void pipeline_configure(Video *video, const Settings *settings) {
  g_mutex_lock(&video->lock);
  video->settings = *settings;
  video->changed = true;
  const GstVideoInfo source = video->source_info;
  g_mutex_unlock(&video->lock);
  if (video->encoder != NULL) set_following(video, &source, settings);
}

void pipeline_key_frame(Video *video) {
  if (video->encoder == NULL) return;
  GstPad *pad = gst_element_get_static_pad(video->encoder, "src");
  gst_pad_send_event(pad, gst_video_event_new_upstream_force_key_unit(GST_CLOCK_TIME_NONE, TRUE, 0));
  gst_object_unref(pad);
}

void pipeline_stop(Video *video) {
  if (video->pipeline != NULL) gst_element_set_state(video->pipeline, GST_STATE_NULL);
}
