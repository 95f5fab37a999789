/* What graph, reader and writer have in common for JavaScript: an object that wraps them, and a callback for some. */
#ifndef FARPOINT_HANDLE_H
#define FARPOINT_HANDLE_H

#include <dds/dds.h>
#include <stdatomic.h>

#include "values.h"

struct handle {
  napi_env env;
  napi_threadsafe_function callback;
  /* It has been called and has not come to it yet: what happens meanwhile needs no call of its own. */
  atomic_bool called;
  /* NULL once closed. */
  void *thing;
  void (*close)(void *);
};

/* Throws what CycloneDDS says; returns NULL. */
napi_value fail_dds(napi_env env, dds_return_t result);

/* `callback` may be NULL. NULL where that failed, thrown. */
struct handle *new_handle(napi_env env, napi_value callback, void (*close)(void *));
/* Calls the handle's callback soon; on any thread. */
void wake(void *handle);
/* The object of a handle whose thing was opened with this result; without one the handle is gone. */
napi_value wrap(napi_env env, struct handle *handle, dds_return_t result, const napi_type_tag *tag);
/* What is wrapped, not closed. Has thrown where it fails. */
bool take_thing(napi_env env, napi_value value, const napi_type_tag *tag, void **to);
/* Closes the handle that is the first argument. */
napi_value close_taken(napi_env env, napi_callback_info info, const napi_type_tag *tag);

#endif
