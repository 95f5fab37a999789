/* Readers for JavaScript. */
#include "reader.h"

#include "handle.h"
#include "js_exports.h"
#include "js_graph.h"

static const napi_type_tag READER_TAG = {0xc83e5a9170f4d26b, 0x36f1b8d40a7ce952};

enum { MOST_QUEUE = 4096 };

static void close_reader(void *reader) { reader_close(reader); }

/* subscribe(graph, topic, type, reliable, transientLocal, depth, userData, queue, onMessages) */
static napi_value js_subscribe(napi_env env, napi_callback_info info) {
  napi_value values[MOST_ARGUMENTS];
  struct request request;
  uint32_t queue;
  if (!take_arguments(env, info, 9, values) || !take_request(env, values, &request) ||
      !take_word(env, values[7], 1, MOST_QUEUE, &queue)) {
    return NULL;
  }
  struct handle *handle = new_handle(env, values[8], close_reader);
  if (handle == NULL) return NULL;
  struct reader *reader = NULL;
  const dds_return_t result = reader_open(request.graph, request.topic, request.type, request.quality, queue, wake,
                                          handle, &reader);
  handle->thing = reader;
  return wrap(env, handle, result, &READER_TAG);
}

static napi_value js_close_reader(napi_env env, napi_callback_info info) { return close_taken(env, info, &READER_TAG); }

/* rest(reader): how many samples wait */
static napi_value js_rest(napi_env env, napi_callback_info info) {
  napi_value values[MOST_ARGUMENTS];
  napi_value result;
  void *reader;
  if (!take_arguments(env, info, 1, values) || !take_thing(env, values[0], &READER_TAG, &reader)) return NULL;
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
  if (!take_arguments(env, info, 3, values) || !take_thing(env, values[0], &READER_TAG, &reader) ||
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
  if (!take_arguments(env, info, 2, values) || !take_thing(env, values[0], &READER_TAG, &reader) ||
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

/* matchedWriters(reader): [guid, userData, …] */
static napi_value js_matched_writers(napi_env env, napi_callback_info info) {
  napi_value values[MOST_ARGUMENTS];
  void *reader;
  if (!take_arguments(env, info, 1, values) || !take_thing(env, values[0], &READER_TAG, &reader)) return NULL;
  return list_matched(env, reader_endpoint(reader), false);
}

bool export_reader(napi_env env, napi_value exports) {
  static const struct addon_function functions[] = {
      {"subscribe", js_subscribe},
      {"closeReader", js_close_reader},
      {"rest", js_rest},
      {"take", js_take},
      {"readerCounts", js_reader_counts},
      {"matchedWriters", js_matched_writers},
  };
  return EXPORT_FUNCTIONS(env, exports, functions);
}
