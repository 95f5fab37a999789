/*
 * Why not videorate: it waits for the next picture before it lets one through, and so adds a frame interval. This
 * element decides at once, keeps the capture times, and writes the resulting rate into the caps, because encoders
 * divide their bit rate by it. A picture that is not newer than the one before is left out, too: encoders fail on it.
 */
#include "rate.h"

#include <gst/video/video.h>

struct _FarpointRate {
  GstBaseTransform parent;
  guint wanted;
  /* When the next picture is due, and the time of the last one; running time. */
  GstClockTime due, last;
  guint64 came, skipped;
};

G_DEFINE_TYPE(FarpointRate, farpoint_rate, GST_TYPE_BASE_TRANSFORM)

static GstStaticPadTemplate sink_template =
    GST_STATIC_PAD_TEMPLATE("sink", GST_PAD_SINK, GST_PAD_ALWAYS, GST_STATIC_CAPS("video/x-raw(ANY)"));
static GstStaticPadTemplate src_template =
    GST_STATIC_PAD_TEMPLATE("src", GST_PAD_SRC, GST_PAD_ALWAYS, GST_STATIC_CAPS("video/x-raw(ANY)"));

/* For a source that does not say its rate. */
enum { UNKNOWN_RATE = 30000, MOST_RATE = 1000000 };

static GstCaps *transform_caps(GstBaseTransform *trans, GstPadDirection direction, GstCaps *caps, GstCaps *filter) {
  GstCaps *any = gst_caps_copy(caps);
  for (guint i = 0; i < gst_caps_get_size(any); i++)
    gst_structure_set(gst_caps_get_structure(any, i), "framerate", GST_TYPE_FRACTION_RANGE, 0, 1, G_MAXINT, 1, NULL);
  if (filter == NULL) return any;
  GstCaps *result = gst_caps_intersect_full(filter, any, GST_CAPS_INTERSECT_FIRST);
  gst_caps_unref(any);
  return result;
}

static GstCaps *fixate_caps(GstBaseTransform *trans, GstPadDirection direction, GstCaps *caps, GstCaps *other) {
  FarpointRate *rate = FARPOINT_RATE(trans);
  GST_OBJECT_LOCK(rate);
  guint wanted = rate->wanted;
  GST_OBJECT_UNLOCK(rate);
  gint n = 0, d = 1;
  gst_structure_get_fraction(gst_caps_get_structure(caps, 0), "framerate", &n, &d);
  if (n <= 0 || d <= 0) {
    n = wanted == 0 ? UNKNOWN_RATE : (gint)wanted;
    d = 1000;
  } else if (wanted != 0 && gst_util_fraction_compare(n, d, (gint)wanted, 1000) > 0) {
    n = (gint)wanted;
    d = 1000;
  }
  other = gst_caps_make_writable(gst_caps_truncate(other));
  gst_structure_fixate_field_nearest_fraction(gst_caps_get_structure(other, 0), "framerate", n, d);
  return gst_caps_fixate(other);
}

static GstFlowReturn transform_ip(GstBaseTransform *trans, GstBuffer *buffer) {
  FarpointRate *rate = FARPOINT_RATE(trans);
  GstClockTime time = gst_segment_to_running_time(&trans->segment, GST_FORMAT_TIME, GST_BUFFER_PTS(buffer));
  GST_OBJECT_LOCK(rate);
  rate->came++;
  bool pass = time != GST_CLOCK_TIME_NONE && (rate->last == GST_CLOCK_TIME_NONE || time > rate->last);
  if (pass && rate->wanted != 0) {
    const GstClockTime interval = 1000 * GST_SECOND / rate->wanted;
    /* Cameras are not punctual: a quarter of an interval early is on time. */
    pass = rate->due == GST_CLOCK_TIME_NONE || time + interval / 4 >= rate->due;
    if (pass) {
      const bool late = rate->due == GST_CLOCK_TIME_NONE || time > rate->due + interval;
      rate->due = (late ? time : rate->due) + interval;
    }
  }
  if (pass)
    rate->last = time;
  else
    rate->skipped++;
  GST_OBJECT_UNLOCK(rate);
  return pass ? GST_FLOW_OK : GST_BASE_TRANSFORM_FLOW_DROPPED;
}

/* Sources may use the buffers that the elements after this one propose. */
static gboolean propose_allocation(GstBaseTransform *trans, GstQuery *decided, GstQuery *query) {
  return gst_pad_peer_query(GST_BASE_TRANSFORM_SRC_PAD(trans), query);
}

static void farpoint_rate_class_init(FarpointRateClass *class) {
  GstElementClass *element = GST_ELEMENT_CLASS(class);
  GstBaseTransformClass *transform = GST_BASE_TRANSFORM_CLASS(class);
  gst_element_class_add_static_pad_template(element, &sink_template);
  gst_element_class_add_static_pad_template(element, &src_template);
  gst_element_class_set_static_metadata(element, "Rate", "Filter/Video", "Leaves out pictures", "Farpoint");
  transform->transform_caps = transform_caps;
  transform->fixate_caps = fixate_caps;
  transform->transform_ip = transform_ip;
  transform->propose_allocation = propose_allocation;
}

static void farpoint_rate_init(FarpointRate *rate) {
  rate->due = rate->last = GST_CLOCK_TIME_NONE;
  gst_base_transform_set_in_place(GST_BASE_TRANSFORM(rate), TRUE);
}

bool farpoint_rate_register(void) {
  return gst_element_register(NULL, "farpointrate", GST_RANK_NONE, farpoint_rate_get_type());
}

void farpoint_rate_want(FarpointRate *rate, guint per_1000_s) {
  const guint wanted = MIN(per_1000_s, MOST_RATE);
  GST_OBJECT_LOCK(rate);
  const bool changed = rate->wanted != wanted;
  rate->wanted = wanted;
  rate->due = GST_CLOCK_TIME_NONE;
  GST_OBJECT_UNLOCK(rate);
  if (changed) gst_base_transform_reconfigure_src(GST_BASE_TRANSFORM(rate));
}

void farpoint_rate_counts(FarpointRate *rate, guint64 *came, guint64 *skipped) {
  GST_OBJECT_LOCK(rate);
  *came = rate->came;
  *skipped = rate->skipped;
  GST_OBJECT_UNLOCK(rate);
}
