#include "log.h"

#include <gst/gst.h>
#include <unistd.h>

void json_string(GString *to, const char *text) {
  char *valid = g_utf8_make_valid(text == NULL ? "" : text, -1);
  g_string_append_c(to, '"');
  for (const char *at = valid; *at != '\0'; at++) {
    const unsigned char c = (unsigned char)*at;
    if (c == '"' || c == '\\') g_string_append_c(to, '\\');
    if (c < 0x20)
      g_string_append_printf(to, "\\u%04x", c);
    else
      g_string_append_c(to, *at);
  }
  g_string_append_c(to, '"');
  g_free(valid);
}

void log_line(const char *level, const char *text) {
  GString *line = g_string_new(NULL);
  g_string_append_printf(line, "{\"level\":\"%s\",\"msg\":", level);
  json_string(line, text);
  g_string_append(line, "}\n");
  ssize_t written = write(STDERR_FILENO, line->str, line->len);
  (void)written;
  g_string_free(line, TRUE);
}

static GLogWriterOutput write_glib(GLogLevelFlags level, const GLogField *fields, gsize count, gpointer data) {
  for (gsize i = 0; i < count; i++)
    if (g_strcmp0(fields[i].key, "MESSAGE") == 0 && (level & (G_LOG_LEVEL_DEBUG | G_LOG_LEVEL_INFO)) == 0)
      log_line(level & (G_LOG_LEVEL_ERROR | G_LOG_LEVEL_CRITICAL) ? "error" : "warn", fields[i].value);
  return G_LOG_WRITER_HANDLED;
}

static void write_gst(GstDebugCategory *category, GstDebugLevel level, const gchar *file, const gchar *function,
                      gint line, GObject *object, GstDebugMessage *message, gpointer data) {
  char *text = g_strdup_printf("%s: %s", gst_debug_category_get_name(category), gst_debug_message_get(message));
  log_line(level <= GST_LEVEL_ERROR ? "error" : level <= GST_LEVEL_WARNING ? "warn" : "debug", text);
  g_free(text);
}

void log_init(void) {
  g_log_set_writer_func(write_glib, NULL, NULL);
  gst_debug_remove_log_function(gst_debug_log_default);
  gst_debug_add_log_function(write_gst, NULL, NULL);
}
