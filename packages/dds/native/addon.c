/*
 * Node-API surface of the DDS addon: participants, readers, writers and what discovery sees. Names, qualities and bytes are
 * decided in TypeScript; see src/addon.ts.
 *
 * Errors are thrown with a code: CLOSED, RANGE (a mistake of the caller), MEMORY, CONFIGURATION (the domain runs with another one), or DDS
 * with what CycloneDDS says.
 */
#include <node_api.h>
#include <stdatomic.h>
#include <stdlib.h>

#include "graph.h"
#include "log.h"
#include "reader.h"
#include "values.h"
#include "writer.h"

static const napi_type_tag GRAPH_TAG = {0x41b7c2f06d9e8a35, 0x9d05e3b17c8246fa};
static const napi_type_tag READER_TAG = {0xc83e5a9170f4d26b, 0x36f1b8d40a7ce952};
static const napi_type_tag WRITER_TAG = {0x7e209d4bb5c183f6, 0xa84c6f03e91d57b2};

enum { MOST_DEPTH = 100000, MOST_QUEUE = 4096, MOST_DOMAIN = 232 };

static napi_value fail_dds(napi_env env, dds_return_t result) {
  if (result == DDS_RETCODE_OUT_OF_RESOURCES) return fail(env, "MEMORY", "out of memory");
  if (result == DDS_RETCODE_INCONSISTENT_POLICY) return fail(env, "CONFIGURATION", "another configuration");
  return fail(env, "DDS", dds_strretcode(-result));
}

/* What graph, reader and writer have in common: an object that wraps them, and a callback for some. */

struct handle {
  napi_env env;
  napi_threadsafe_function callback;
  /* It has been called and has not come to it yet: what happens meanwhile needs no call of its own. */
  atomic_bool called;
  /* NULL once closed. */
  void *thing;
  void (*close)(void *);
};

/* On a thread of CycloneDDS. */
static void wake(void *context) {
  struct handle *handle = context;
  if (!atomic_exchange(&handle->called, true)) {
    napi_call_threadsafe_function(handle->callback, NULL, napi_tsfn_nonblocking);
  }
}

static void call_js(napi_env env, napi_value callback, void *context, void *data) {
  /* Once released it is called without an environment, and the handle may be gone. */
  if (env == NULL || callback == NULL) return;
  struct handle *handle = context;
  atomic_store(&handle->called, false);
  napi_value self, error;
  napi_get_undefined(env, &self);
  if (napi_call_function(env, self, callback, 0, NULL, NULL) != napi_pending_exception) return;
  /* As of any callback: an error that nobody catches ends the process. */
  napi_get_and_clear_last_exception(env, &error);
  napi_fatal_exception(env, error);
}

/* Also as the environment goes: what is open is closed before its callback. */
static void close_thing(void *data) {
  struct handle *handle = data;
  if (handle->thing != NULL) handle->close(handle->thing);
  handle->thing = NULL;
  if (handle->callback != NULL) napi_release_threadsafe_function(handle->callback, napi_tsfn_abort);
  handle->callback = NULL;
}

static void close_handle(struct handle *handle) {
  if (handle->thing == NULL) return;
  napi_remove_env_cleanup_hook(handle->env, close_thing, handle);
  close_thing(handle);
}

static void finalize(napi_env env, void *data, void *hint) {
  close_handle(data);
  free(data);
}

/* `callback` may be NULL. */
static struct handle *new_handle(napi_env env, napi_value callback, void (*close)(void *)) {
  struct handle *handle = calloc(1, sizeof *handle);
  if (handle == NULL) {
    fail(env, "MEMORY", "out of memory");
    return NULL;
  }
  handle->env = env;
  handle->close = close;
  if (callback == NULL) return handle;
  napi_value name;
  napi_create_string_utf8(env, "farpoint-dds", NAPI_AUTO_LENGTH, &name);
  if (napi_create_threadsafe_function(env, callback, NULL, name, 0, 1, NULL, NULL, handle, call_js, &handle->callback) !=
      napi_ok) {
    free(handle);
    fail(env, "RANGE", "not a function");
    return NULL;
  }
  /* Whoever waits for messages alone may end. */
  napi_unref_threadsafe_function(env, handle->callback);
  return handle;
}

/* The object of a handle whose thing was opened with this result. */
static napi_value wrap(napi_env env, struct handle *handle, dds_return_t result, const napi_type_tag *tag) {
  napi_value object;
  if (result < 0 || napi_create_object(env, &object) != napi_ok ||
      napi_wrap(env, object, handle, finalize, NULL, NULL) != napi_ok) {
    close_thing(handle);
    free(handle);
    return fail_dds(env, result < 0 ? result : DDS_RETCODE_OUT_OF_RESOURCES);
  }
  napi_type_tag_object(env, object, tag);
  napi_add_env_cleanup_hook(env, close_thing, handle);
  return object;
}

static bool thing_of(napi_env env, napi_value value, const napi_type_tag *tag, void **to) {
  void *data = NULL;
  if (!take_handle(env, value, tag, &data)) return false;
  *to = ((struct handle *)data)->thing;
  if (*to != NULL) return true;
  fail(env, "CLOSED", "closed");
  return false;
}

static napi_value js_close(napi_env env, napi_callback_info info, const napi_type_tag *tag) {
  napi_value values[MOST_ARGUMENTS];
  void *data = NULL;
  if (take_arguments(env, info, 1, values) && take_handle(env, values[0], tag, &data)) close_handle(data);
  return NULL;
}

/* Graphs */

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

/* lastLog(): what CycloneDDS said last, empty where nothing */
static napi_value js_last_log(napi_env env, napi_callback_info info) {
  char line[MOST_NAME];
  napi_value result;
  log_take(line, sizeof line);
  return napi_create_string_utf8(env, line, NAPI_AUTO_LENGTH, &result) == napi_ok ? result : NULL;
}

static napi_value js_close_graph(napi_env env, napi_callback_info info) { return js_close(env, info, &GRAPH_TAG); }

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
  if (!take_arguments(env, info, 2, values) || !thing_of(env, values[0], &GRAPH_TAG, &graph) ||
      !take_bool(env, values[1], &publishers)) {
    return NULL;
  }
  napi_create_array(env, &listing.list);
  const dds_return_t result = graph_others(graph, publishers, add_other, &listing);
  return result < 0 ? fail_dds(env, result) : listing.list;
}

/* Readers and writers */

struct request {
  struct graph *graph;
  char topic[MOST_NAME];
  char type[MOST_NAME];
  struct topic_quality quality;
};

/* graph, topic, type, reliable, transientLocal, depth */
static bool take_request(napi_env env, napi_value *values, struct request *to) {
  void *graph;
  uint32_t depth;
  if (!thing_of(env, values[0], &GRAPH_TAG, &graph) || !take_text(env, values[1], to->topic, sizeof to->topic) ||
      !take_text(env, values[2], to->type, sizeof to->type) || !take_bool(env, values[3], &to->quality.reliable) ||
      !take_bool(env, values[4], &to->quality.transient_local) || !take_word(env, values[5], 1, MOST_DEPTH, &depth)) {
    return false;
  }
  to->graph = graph;
  to->quality.depth = (int32_t)depth;
  return true;
}

static void close_reader(void *reader) { reader_close(reader); }

/* subscribe(graph, topic, type, reliable, transientLocal, depth, queue, onMessages) */
static napi_value js_subscribe(napi_env env, napi_callback_info info) {
  napi_value values[MOST_ARGUMENTS];
  struct request request;
  uint32_t queue;
  if (!take_arguments(env, info, 8, values) || !take_request(env, values, &request) ||
      !take_word(env, values[6], 1, MOST_QUEUE, &queue)) {
    return NULL;
  }
  struct handle *handle = new_handle(env, values[7], close_reader);
  if (handle == NULL) return NULL;
  struct reader *reader = NULL;
  const dds_return_t result = reader_open(request.graph, request.topic, request.type, request.quality, queue, wake,
                                          handle, &reader);
  handle->thing = reader;
  return wrap(env, handle, result, &READER_TAG);
}

static napi_value js_close_reader(napi_env env, napi_callback_info info) { return js_close(env, info, &READER_TAG); }

/* rest(reader): how many wait */
static napi_value js_rest(napi_env env, napi_callback_info info) {
  napi_value values[MOST_ARGUMENTS];
  napi_value result;
  void *reader;
  if (!take_arguments(env, info, 1, values) || !thing_of(env, values[0], &READER_TAG, &reader)) return NULL;
  napi_create_uint32(env, (uint32_t)reader_rest(reader), &result);
  return result;
}

/* take(reader, to, [receivedMs]): size, or -1 */
static napi_value js_take(napi_env env, napi_callback_info info) {
  napi_value values[MOST_ARGUMENTS];
  napi_value result;
  void *reader;
  struct bytes to;
  double *received;
  int64_t received_ns = 0;
  if (!take_arguments(env, info, 3, values) || !thing_of(env, values[0], &READER_TAG, &reader) ||
      !take_bytes(env, values[1], &to) || !take_doubles(env, values[2], 1, &received)) {
    return NULL;
  }
  const int64_t size = reader_take(reader, to.at, to.count, &received_ns);
  received[0] = (double)received_ns / 1e6;
  napi_create_int64(env, size, &result);
  return result;
}

/* readerCounts(reader, [received, dropped, lost, publishers]) */
static napi_value js_reader_counts(napi_env env, napi_callback_info info) {
  napi_value values[MOST_ARGUMENTS];
  void *reader;
  double *to;
  if (!take_arguments(env, info, 2, values) || !thing_of(env, values[0], &READER_TAG, &reader) ||
      !take_doubles(env, values[1], 4, &to)) {
    return NULL;
  }
  const struct reader_counts counts = reader_counts(reader);
  to[0] = (double)counts.received;
  to[1] = (double)counts.dropped;
  to[2] = counts.lost;
  to[3] = counts.publishers;
  return NULL;
}

static void close_writer(void *writer) { writer_close(writer); }

/* advertise(graph, topic, type, reliable, transientLocal, depth) */
static napi_value js_advertise(napi_env env, napi_callback_info info) {
  napi_value values[MOST_ARGUMENTS];
  struct request request;
  if (!take_arguments(env, info, 6, values) || !take_request(env, values, &request)) return NULL;
  struct handle *handle = new_handle(env, NULL, close_writer);
  if (handle == NULL) return NULL;
  struct writer *writer = NULL;
  const dds_return_t result = writer_open(request.graph, request.topic, request.type, request.quality, &writer);
  handle->thing = writer;
  return wrap(env, handle, result, &WRITER_TAG);
}

static napi_value js_close_writer(napi_env env, napi_callback_info info) { return js_close(env, info, &WRITER_TAG); }

/* write(writer, bytes): whether it was taken; not where a reliable subscriber is too slow */
static napi_value js_write(napi_env env, napi_callback_info info) {
  napi_value values[MOST_ARGUMENTS];
  napi_value result;
  void *writer;
  struct bytes bytes;
  if (!take_arguments(env, info, 2, values) || !thing_of(env, values[0], &WRITER_TAG, &writer) ||
      !take_bytes(env, values[1], &bytes)) {
    return NULL;
  }
  if (bytes.count < ENCAPSULATION_BYTES) return fail(env, "RANGE", "no encapsulation header");
  const dds_return_t written = writer_write(writer, bytes.at, bytes.count);
  if (written < 0 && written != DDS_RETCODE_TIMEOUT) return fail_dds(env, written);
  napi_get_boolean(env, written >= 0, &result);
  return result;
}

/* subscribers(writer) */
static napi_value js_subscribers(napi_env env, napi_callback_info info) {
  napi_value values[MOST_ARGUMENTS];
  napi_value result;
  void *writer;
  if (!take_arguments(env, info, 1, values) || !thing_of(env, values[0], &WRITER_TAG, &writer)) return NULL;
  napi_create_uint32(env, writer_subscribers(writer), &result);
  return result;
}

NAPI_MODULE_INIT() {
  log_install();
  const struct {
    const char *name;
    napi_callback call;
  } functions[] = {
      {"open", js_open},
      {"lastLog", js_last_log},
      {"closeGraph", js_close_graph},
      {"others", js_others},
      {"subscribe", js_subscribe},
      {"closeReader", js_close_reader},
      {"rest", js_rest},
      {"take", js_take},
      {"readerCounts", js_reader_counts},
      {"advertise", js_advertise},
      {"closeWriter", js_close_writer},
      {"write", js_write},
      {"subscribers", js_subscribers},
  };
  for (size_t i = 0; i < sizeof functions / sizeof functions[0]; i++) {
    napi_value value;
    if (napi_create_function(env, functions[i].name, NAPI_AUTO_LENGTH, functions[i].call, NULL, &value) != napi_ok ||
        napi_set_named_property(env, exports, functions[i].name, value) != napi_ok) {
      return NULL;
    }
  }
  return exports;
}
