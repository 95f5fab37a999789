/* Mappings and places in them, taken from JavaScript. Each that fails has thrown. */
#ifndef FARPOINT_JS_MAPPING_H
#define FARPOINT_JS_MAPPING_H

#include "values.h"
#include "mapping.h"

/* One that is not closed. */
bool take_mapping(napi_env env, napi_value value, struct mapping **to);
/* An offset, a multiple of `align`, from which on `count` bytes lie in the mapping. */
bool take_range(napi_env env, struct mapping *mapping, napi_value value, size_t align, size_t count, size_t *to);
bool check_writable(napi_env env, struct mapping *mapping);

#endif
