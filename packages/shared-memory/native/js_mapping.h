/* Mappings and offsets in them, as arguments from JavaScript. Each function that fails has thrown. */
#ifndef FARPOINT_JS_MAPPING_H
#define FARPOINT_JS_MAPPING_H

#include "values.h"
#include "mapping.h"

/* A mapping that is not closed. */
bool take_mapping(napi_env env, napi_value value, struct mapping **to);
/* An offset, a multiple of `align`, followed by at least `count` bytes in the mapping. */
bool take_range(napi_env env, struct mapping *mapping, napi_value value, size_t align, size_t count, size_t *to);
bool check_writable(napi_env env, struct mapping *mapping);

#endif
