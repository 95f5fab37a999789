/*
 * The shared-memory addon: guarded access to mapped files, and threads that wait. TypeScript decides what the bytes
 * mean (src/addon.ts); only the two decoders and the command block know a layout here.
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
