#include "fault.h"

#include <signal.h>
#include <unistd.h>

#include "log.h"
#include "wire.h"

static gint failed;

static void on_signal(int signal) {
  if (signal == SIGALRM) _exit(1);
  alarm(STOP_S);
  wire_close();
}

void handle_signals(void) {
  struct sigaction action = {.sa_handler = on_signal};
  sigaction(SIGTERM, &action, NULL);
  sigaction(SIGINT, &action, NULL);
  sigaction(SIGALRM, &action, NULL);
  signal(SIGPIPE, SIG_IGN);
}

static gboolean quit(gpointer loop) {
  g_main_loop_quit(loop);
  return G_SOURCE_REMOVE;
}

void end_soon(GMainLoop *loop) { g_idle_add(quit, loop); }

bool has_failed(void) { return g_atomic_int_get(&failed) != 0; }

void fault_tell(GMainLoop *loop, const char *reason, const char *said, const char *detail) {
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
  end_soon(loop);
}

bool fault_is_not_negotiated(GstMessage *message, const GError *error) {
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

bool fault_is_missing_element(const GError *error) {
  return g_error_matches(error, GST_CORE_ERROR, GST_CORE_ERROR_MISSING_PLUGIN) ||
         g_error_matches(error, GST_STREAM_ERROR, GST_STREAM_ERROR_CODEC_NOT_FOUND);
}
