#include "handle.h"

#include <stdlib.h>

napi_value fail_dds(napi_env env, dds_return_t result) {
  if (result == DDS_RETCODE_OUT_OF_RESOURCES) return fail(env, "MEMORY", "out of memory");
  if (result == DDS_RETCODE_INCONSISTENT_POLICY) return fail(env, "CONFIGURATION", "another configuration");
  return fail(env, "DDS", dds_strretcode(-result));
}

void wake(void *context) {
  struct handle *handle = context;
  if (!atomic_exchange(&handle->called, true)) {
    napi_call_threadsafe_function(handle->callback, NULL, napi_tsfn_nonblocking);
  }
}

static void call_js(napi_env env, napi_value callback, void *context, void *data) {
  /* After its release it is called without an environment, and the handle may be gone. */
  if (env == NULL || callback == NULL) return;
  struct handle *handle = context;
  atomic_store(&handle->called, false);
  call_back(env, callback, 0, NULL);
}

/* Also runs when the environment ends: an open thing is closed before its callback. */
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

struct handle *new_handle(napi_env env, napi_value callback, void (*close)(void *)) {
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
  /* A program that only waits for messages may exit. */
  napi_unref_threadsafe_function(env, handle->callback);
  return handle;
}

napi_value wrap(napi_env env, struct handle *handle, dds_return_t result, const napi_type_tag *tag) {
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

bool take_thing(napi_env env, napi_value value, const napi_type_tag *tag, void **to) {
  void *data = NULL;
  if (!take_handle(env, value, tag, &data)) return false;
  *to = ((struct handle *)data)->thing;
  if (*to != NULL) return true;
  fail(env, "CLOSED", "closed");
  return false;
}

napi_value close_taken(napi_env env, napi_callback_info info, const napi_type_tag *tag) {
  napi_value values[MOST_ARGUMENTS];
  void *data = NULL;
  if (take_arguments(env, info, 1, values) && take_handle(env, values[0], tag, &data)) close_handle(data);
  return NULL;
}
