/*
 * The shared-memory addon: guarded access to mapped files, and threads that wait. What the bytes mean is decided in TypeScript
 * (src/addon.ts); nothing here knows a layout but the two decoders and the command block.
 */
#include "guard.h"
#include "js_exports.h"
#include "values.h"

NAPI_MODULE_INIT() {
  const int installed = guard_install();
  if (installed != 0) return fail_errno(env, installed);
  const bool exported = export_mapping(env, exports) && export_decode(env, exports) && export_watch(env, exports) &&
                        export_control(env, exports);
  return exported ? exports : NULL;
}
