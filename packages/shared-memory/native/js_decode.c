/* Decodes frames in a mapping into JavaScript's arrays. */
#include "decode.h"
#include "js_exports.h"
#include "js_mapping.h"

/* unpackPoints64(handle, offset, bytes, to): whether every point is green */
static napi_value js_unpack_points64(napi_env env, napi_callback_info info) {
  napi_value values[MOST_ARGUMENTS];
  napi_value result;
  struct mapping *mapping;
  struct bytes to;
  size_t offset, count;
  if (!take_arguments(env, info, 4, values) || !take_mapping(env, values[0], &mapping) ||
      !take_size(env, values[2], &count) || !take_range(env, mapping, values[1], 1, count, &offset) ||
      !take_bytes(env, values[3], &to)) {
    return NULL;
  }
  if (count % 8 != 0 || to.count < count * 2 || (uintptr_t)to.at % 4 != 0) return fail(env, "RANGE", (int64_t)count);
  bool green = false;
  const int64_t fault = decode_points64(mapping, offset, count, (uint32_t *)(void *)to.at, &green);
  if (fault >= 0) return fail_fault(env, fault);
  napi_get_boolean(env, green, &result);
  return result;
}

/* images(handle, kind, depthOffset, colourOffset, pixels, unit, depth, colour) */
static napi_value js_images(napi_env env, napi_callback_info info) {
  napi_value values[MOST_ARGUMENTS];
  struct mapping *mapping;
  struct bytes depth, colour;
  struct depth_frame frame;
  uint32_t kind;
  double unit;
  if (!take_arguments(env, info, 8, values) || !take_mapping(env, values[0], &mapping) || !take_word(env, values[1], &kind) ||
      !take_size(env, values[4], &frame.pixels) || !take_number(env, values[5], &unit) ||
      !take_bytes(env, values[6], &depth) || !take_bytes(env, values[7], &colour)) {
    return NULL;
  }
  /* Too many pixels are refused before their number is multiplied. */
  if (kind > DEPTH_32 || depth.count / 4 < frame.pixels || colour.count / 4 < frame.pixels ||
      (uintptr_t)depth.at % 4 != 0 || (uintptr_t)colour.at % 4 != 0) {
    return fail(env, "RANGE", (int64_t)frame.pixels);
  }
  frame.kind = (enum depth_kind)kind;
  frame.unit = (float)unit;
  const size_t depth_bytes = frame.pixels * (frame.kind == DEPTH_OF_POINTS ? 16 : frame.kind == DEPTH_16 ? 2 : 4);
  const size_t colour_bytes = frame.kind == DEPTH_OF_POINTS ? 0 : frame.pixels * 4;
  if (!take_range(env, mapping, values[2], 1, depth_bytes, &frame.depth) ||
      !take_range(env, mapping, values[3], 1, colour_bytes, &frame.colour)) {
    return NULL;
  }
  return fail_fault(env, decode_images(mapping, &frame, (float *)(void *)depth.at, (uint32_t *)(void *)colour.at));
}

bool export_decode(napi_env env, napi_value exports) {
  static const struct addon_function functions[] = {
      {"unpackPoints64", js_unpack_points64},
      {"images", js_images},
  };
  return EXPORT_FUNCTIONS(env, exports, functions);
}
