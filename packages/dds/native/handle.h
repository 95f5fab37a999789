/* Common part of graph, reader and writer for JavaScript: an object that wraps them and, for some, a callback. */
#ifndef FARPOINT_HANDLE_H
#define FARPOINT_HANDLE_H

#include <dds/dds.h>
#include <stdatomic.h>

#include "values.h"

struct handle {
  napi_env env;
  napi_threadsafe_function callback;
  /* The callback was scheduled and has not run yet, so further events need no call of their own. */
  atomic_bool called;
  /* NULL once closed. */
  void *thing;
  void (*close)(void *);
};

/* Throws CycloneDDS's error; returns NULL. */
napi_value fail_dds(napi_env env, dds_return_t result);

/* `callback` may be NULL. Returns NULL on failure, having thrown. */
struct handle *new_handle(napi_env env, napi_value callback, void (*close)(void *));
/* Schedules the handle's callback; may be called on any thread. */
void wake(void *handle);
/* The object of a handle whose thing was opened with this result; frees the handle if opening failed. */
napi_value wrap(napi_env env, struct handle *handle, dds_return_t result, const napi_type_tag *tag);
/* The wrapped thing, if it is not closed. Has thrown on failure. */
bool take_thing(napi_env env, napi_value value, const napi_type_tag *tag, void **to);
/* Closes the handle that is the first argument. */
napi_value close_taken(napi_env env, napi_callback_info info, const napi_type_tag *tag);

#endif
