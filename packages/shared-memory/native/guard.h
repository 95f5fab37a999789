/*
 * Access to a mapping whose file another process may truncate.
 *
 * If a mapped file is truncated, the first access to a missing page raises SIGBUS, which would end the process. Between
 * guard_run's set-up and its end, such a fault inside the given mapping is caught and reported with its offset. Faults
 * anywhere else go to the previous handler of SIGBUS.
 */
#ifndef FARPOINT_GUARD_H
#define FARPOINT_GUARD_H

#include <setjmp.h>
#include <stdatomic.h>
#include <stddef.h>
#include <stdint.h>

struct guard {
  sigjmp_buf escape;
  const uint8_t *base;
  size_t bytes;
  const uint8_t *fault;
};

/*
 * The guard of the calling thread, NULL outside. In the thread's static block, because a signal handler must not
 * allocate.
 */
extern _Thread_local struct guard *volatile active_guard __attribute__((tls_model("initial-exec")));

/* Once per process. Returns 0, or errno. */
int guard_install(void);

/*
 * Runs `statement` guarded; `faulted` becomes the offset of the fault, or -1. Do not use local variables assigned in
 * the statement after a fault.
 */
#define GUARDED(mapping_base, mapping_bytes, faulted, statement)     \
  do {                                                               \
    struct guard guard_ = {.base = (mapping_base), .bytes = (mapping_bytes)}; \
    if (sigsetjmp(guard_.escape, 1) == 0) {                          \
      active_guard = &guard_;                                        \
      atomic_signal_fence(memory_order_seq_cst);                     \
      statement;                                                     \
      atomic_signal_fence(memory_order_seq_cst);                     \
      active_guard = NULL;                                           \
      (faulted) = -1;                                                \
    } else {                                                         \
      active_guard = NULL;                                           \
      (faulted) = (int64_t)(guard_.fault - guard_.base);             \
    }                                                                \
  } while (0)

#endif
