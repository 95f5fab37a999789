/* Converts values from and to JavaScript, with checks. Each function that fails has thrown. */
#ifndef FARPOINT_VALUES_H
#define FARPOINT_VALUES_H

#include <farpoint_addon.h>
#include <stdint.h>

enum { MOST_NAME = 512, MOST_CONFIGURATION = 65536 };

struct bytes {
  uint8_t *at;
  size_t count;
};

/*
 * Throws an error with a code: CLOSED, RANGE (a mistake of the caller), MEMORY, CONFIGURATION (the domain runs with a
 * different one), or DDS with CycloneDDS's message. Returns NULL.
 */
napi_value fail(napi_env env, const char *code, const char *message);

bool take_word(napi_env env, napi_value value, uint32_t least, uint32_t most, uint32_t *to);
/* Zero-terminated; refuses texts that contain a zero. */
bool take_text(napi_env env, napi_value value, char *to, size_t room);
/* Of a Uint8Array. */
bool take_bytes(napi_env env, napi_value value, struct bytes *to);
/* Of a Float64Array with at least `count` numbers. */
bool take_doubles(napi_env env, napi_value value, size_t count, double **to);

#endif
