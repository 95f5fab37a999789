/* A file mapped into memory, shared by JavaScript's handle and the threads that watch or write it. */
#ifndef FARPOINT_MAPPING_H
#define FARPOINT_MAPPING_H

#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "guard.h"

struct mapping {
  atomic_int references;
  atomic_bool closed;
  int fd;
  bool writable;
  uint8_t *base;
  size_t bytes;
};

enum open_fault {
  OPEN_OK,
  /* `detail` is errno. */
  OPEN_ERRNO,
  OPEN_NOT_A_FILE,
  /* Everybody may write to it. */
  OPEN_WORLD_WRITABLE,
  /* Its owner is neither this user, nor root, nor the one that is allowed; `detail` is the owner's id. */
  OPEN_FOREIGN,
  /* `detail` is the actual size. */
  OPEN_WRONG_SIZE,
};

struct open_request {
  const char *path;
  bool writable;
  /* Creates the file if it is missing; with `resize`, sets its size to `bytes`. */
  bool create;
  /* The file must not exist yet. */
  bool exclusive;
  bool resize;
  /* The required size; 0 accepts any size but 0. */
  size_t bytes;
  unsigned mode;
  /* A user whose files are as good as our own; any user's with `any_owner`. */
  uint32_t owner;
  bool any_owner;
};

enum open_fault mapping_open(const struct open_request *request, struct mapping **out, int64_t *detail);
struct mapping *mapping_retain(struct mapping *mapping);
void mapping_release(struct mapping *mapping);

/* Single aligned loads and stores; -1 or the offset of the fault. */
int64_t mapping_load8(struct mapping *mapping, size_t offset, uint32_t *value);
int64_t mapping_load32(struct mapping *mapping, size_t offset, uint32_t *value);
int64_t mapping_store8(struct mapping *mapping, size_t offset, uint8_t value);
int64_t mapping_store32(struct mapping *mapping, size_t offset, uint32_t value);
int64_t mapping_copy_out(struct mapping *mapping, size_t offset, void *to, size_t bytes);
int64_t mapping_copy_in(struct mapping *mapping, size_t offset, const void *from, size_t bytes);
/* Wakes everybody who waits for the word to change. */
void mapping_wake(struct mapping *mapping, size_t offset);

#endif
