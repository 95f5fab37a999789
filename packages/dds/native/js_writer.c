/* Writers for JavaScript. */
#include "writer.h"

#include "handle.h"
#include "js_exports.h"
#include "js_graph.h"

static const napi_type_tag WRITER_TAG = {0x7e209d4bb5c183f6, 0xa84c6f03e91d57b2};

static void close_writer(void *writer) { writer_close(writer); }

/* advertise(graph, topic, type, reliable, transientLocal, depth, userData) */
static napi_value js_advertise(napi_env env, napi_callback_info info) {
  napi_value values[MOST_ARGUMENTS];
  struct request request;
  if (!take_arguments(env, info, 7, values) || !take_request(env, values, &request)) return NULL;
  struct handle *handle = new_handle(env, NULL, close_writer);
  if (handle == NULL) return NULL;
  struct writer *writer = NULL;
  const dds_return_t result = writer_open(request.graph, request.topic, request.type, request.quality, &writer);
  handle->thing = writer;
  return wrap(env, handle, result, &WRITER_TAG);
}

static napi_value js_close_writer(napi_env env, napi_callback_info info) { return close_taken(env, info, &WRITER_TAG); }

/* write(writer, bytes): whether it was accepted; not if a reliable subscriber is too slow */
static napi_value js_write(napi_env env, napi_callback_info info) {
  napi_value values[MOST_ARGUMENTS];
  napi_value result;
  void *writer;
  struct bytes bytes;
  if (!take_arguments(env, info, 2, values) || !take_thing(env, values[0], &WRITER_TAG, &writer) ||
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
  if (!take_arguments(env, info, 1, values) || !take_thing(env, values[0], &WRITER_TAG, &writer)) return NULL;
  napi_create_uint32(env, writer_subscribers(writer), &result);
  return result;
}

/* matchedReaders(writer): [guid, userData, …] */
static napi_value js_matched_readers(napi_env env, napi_callback_info info) {
  napi_value values[MOST_ARGUMENTS];
  void *writer;
  if (!take_arguments(env, info, 1, values) || !take_thing(env, values[0], &WRITER_TAG, &writer)) return NULL;
  return list_matched(env, writer_endpoint(writer), true);
}

bool export_writer(napi_env env, napi_value exports) {
  static const struct addon_function functions[] = {
      {"advertise", js_advertise},
      {"closeWriter", js_close_writer},
      {"write", js_write},
      {"subscribers", js_subscribers},
      {"matchedReaders", js_matched_readers},
  };
  return EXPORT_FUNCTIONS(env, exports, functions);
}
