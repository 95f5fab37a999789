/* Graphs for JavaScript: participants, and discovery data. */
#include "js_graph.h"

#include <stdio.h>

#include "handle.h"
#include "js_exports.h"
#include "log.h"

static const napi_type_tag GRAPH_TAG = {0x41b7c2f06d9e8a35, 0x9d05e3b17c8246fa};

enum { MOST_DEPTH = 100000, MOST_DOMAIN = 232 };

static void close_graph(void *graph) { graph_close(graph); }

/* open(domain, configuration, onDiscovery) */
static napi_value js_open(napi_env env, napi_callback_info info) {
  static _Thread_local char configuration[MOST_CONFIGURATION];
  napi_value values[MOST_ARGUMENTS];
  uint32_t domain;
  if (!take_arguments(env, info, 3, values) || !take_word(env, values[0], 0, MOST_DOMAIN, &domain) ||
      !take_text(env, values[1], configuration, sizeof configuration)) {
    return NULL;
  }
  struct handle *handle = new_handle(env, values[2], close_graph);
  if (handle == NULL) return NULL;
  struct graph *graph = NULL;
  const dds_return_t result = graph_open(domain, configuration, wake, handle, &graph);
  handle->thing = graph;
  return wrap(env, handle, result, &GRAPH_TAG);
}

/* lastLog(): the last message that CycloneDDS logged, empty if none */
static napi_value js_last_log(napi_env env, napi_callback_info info) {
  char line[MOST_NAME];
  napi_value result;
  log_take(line, sizeof line);
  return napi_create_string_utf8(env, line, NAPI_AUTO_LENGTH, &result) == napi_ok ? result : NULL;
}

static napi_value js_close_graph(napi_env env, napi_callback_info info) { return close_taken(env, info, &GRAPH_TAG); }

struct listing {
  napi_env env;
  napi_value list;
  uint32_t length;
};

static void append(struct listing *listing, napi_value value) {
  napi_set_element(listing->env, listing->list, listing->length++, value);
}

static void add_other(void *context, const char *topic, const char *type, bool reliable, bool transient_local) {
  struct listing *listing = context;
  napi_value names[2], flags[2];
  if (napi_create_string_utf8(listing->env, topic, NAPI_AUTO_LENGTH, &names[0]) != napi_ok ||
      napi_create_string_utf8(listing->env, type, NAPI_AUTO_LENGTH, &names[1]) != napi_ok) {
    return;
  }
  napi_get_boolean(listing->env, reliable, &flags[0]);
  napi_get_boolean(listing->env, transient_local, &flags[1]);
  append(listing, names[0]);
  append(listing, names[1]);
  append(listing, flags[0]);
  append(listing, flags[1]);
}

/* others(graph, publishers): [topic, type, reliable, transientLocal, topic, …] */
static napi_value js_others(napi_env env, napi_callback_info info) {
  napi_value values[MOST_ARGUMENTS];
  void *graph;
  bool publishers;
  struct listing listing = {.env = env};
  if (!take_arguments(env, info, 2, values) || !take_thing(env, values[0], &GRAPH_TAG, &graph) ||
      !take_bool(env, values[1], &publishers)) {
    return NULL;
  }
  napi_create_array(env, &listing.list);
  const dds_return_t result = graph_others(graph, publishers, add_other, &listing);
  return result < 0 ? fail_dds(env, result) : listing.list;
}

static void add_matched(void *context, const dds_guid_t *guid, const char *user_data) {
  struct listing *listing = context;
  napi_value values[2];
  char hex[2 * sizeof guid->v + 1];
  for (size_t i = 0; i < sizeof guid->v; i++) snprintf(hex + 2 * i, 3, "%02x", guid->v[i]);
  if (napi_create_string_utf8(listing->env, hex, NAPI_AUTO_LENGTH, &values[0]) != napi_ok ||
      napi_create_string_utf8(listing->env, user_data, NAPI_AUTO_LENGTH, &values[1]) != napi_ok) {
    return;
  }
  append(listing, values[0]);
  append(listing, values[1]);
}

napi_value list_matched(napi_env env, const struct endpoint *endpoint, bool is_writer) {
  struct listing listing = {.env = env};
  napi_create_array(env, &listing.list);
  const dds_return_t result = endpoint_matched(endpoint, is_writer, add_matched, &listing);
  return result < 0 ? fail_dds(env, result) : listing.list;
}

bool take_request(napi_env env, napi_value *values, struct request *to) {
  void *graph;
  uint32_t depth;
  if (!take_thing(env, values[0], &GRAPH_TAG, &graph) || !take_text(env, values[1], to->topic, sizeof to->topic) ||
      !take_text(env, values[2], to->type, sizeof to->type) || !take_bool(env, values[3], &to->quality.reliable) ||
      !take_bool(env, values[4], &to->quality.transient_local) || !take_word(env, values[5], 1, MOST_DEPTH, &depth) ||
      !take_text(env, values[6], to->user_data, sizeof to->user_data)) {
    return false;
  }
  to->graph = graph;
  to->quality.depth = (int32_t)depth;
  to->quality.user_data = to->user_data;
  return true;
}

bool export_graph(napi_env env, napi_value exports) {
  static const struct addon_function functions[] = {
      {"open", js_open},
      {"lastLog", js_last_log},
      {"closeGraph", js_close_graph},
      {"others", js_others},
  };
  return EXPORT_FUNCTIONS(env, exports, functions);
}
