#include "mapping.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <linux/futex.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

static enum open_fault fault(int fd, enum open_fault kind, int64_t value, int64_t *detail) {
  *detail = value;
  if (fd >= 0) close(fd);
  return kind;
}

/* Opens an existing file, or creates it: only a file that this call creates gets the given mode, whatever the umask. */
static int open_file(const struct open_request *request) {
  const int flags = (request->writable ? O_RDWR : O_RDONLY) | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK;
  for (int attempt = 0; attempt < 8; attempt++) {
    if (!request->exclusive) {
      const int found = open(request->path, flags);
      if (found >= 0 || errno != ENOENT || !request->create) return found;
    }
    const int made = open(request->path, flags | O_CREAT | O_EXCL, request->mode);
    if (made >= 0) {
      if (fchmod(made, request->mode) == 0) return made;
      const int saved = errno;
      close(made);
      errno = saved;
      return -1;
    }
    if (errno != EEXIST || request->exclusive) return -1;
  }
  return -1;
}

enum open_fault mapping_open(const struct open_request *request, struct mapping **out, int64_t *detail) {
  const int fd = open_file(request);
  if (fd < 0) return fault(-1, OPEN_ERRNO, errno, detail);
  struct stat status;
  if (fstat(fd, &status) != 0) return fault(fd, OPEN_ERRNO, errno, detail);
  if (!S_ISREG(status.st_mode)) return fault(fd, OPEN_NOT_A_FILE, 0, detail);
  if ((status.st_mode & S_IWOTH) != 0) return fault(fd, OPEN_WORLD_WRITABLE, status.st_mode & 07777, detail);
  /* In a folder that everybody may write, somebody else may have been the first to make it. Whoever owns a file can
     change it, or its permissions, at any time. */
  if (!request->any_owner && status.st_uid != geteuid() && status.st_uid != 0 && status.st_uid != request->owner) {
    return fault(fd, OPEN_FOREIGN, status.st_uid, detail);
  }
  size_t bytes = (size_t)status.st_size;
  if (request->create && request->resize && bytes != request->bytes) {
    if (ftruncate(fd, (off_t)request->bytes) != 0) return fault(fd, OPEN_ERRNO, errno, detail);
    bytes = request->bytes;
  }
  if (bytes == 0 || (request->bytes != 0 && bytes != request->bytes)) {
    return fault(fd, OPEN_WRONG_SIZE, (int64_t)bytes, detail);
  }
  void *base = mmap(NULL, bytes, PROT_READ | (request->writable ? PROT_WRITE : 0), MAP_SHARED, fd, 0);
  if (base == MAP_FAILED) return fault(fd, OPEN_ERRNO, errno, detail);
  struct mapping *mapping = calloc(1, sizeof *mapping);
  if (mapping == NULL) {
    munmap(base, bytes);
    return fault(fd, OPEN_ERRNO, ENOMEM, detail);
  }
  atomic_init(&mapping->references, 1);
  atomic_init(&mapping->closed, false);
  mapping->fd = fd;
  mapping->writable = request->writable;
  mapping->base = base;
  mapping->bytes = bytes;
  *out = mapping;
  return OPEN_OK;
}

struct mapping *mapping_retain(struct mapping *mapping) {
  atomic_fetch_add(&mapping->references, 1);
  return mapping;
}

void mapping_release(struct mapping *mapping) {
  if (atomic_fetch_sub(&mapping->references, 1) != 1) return;
  munmap(mapping->base, mapping->bytes);
  close(mapping->fd);
  free(mapping);
}

int64_t mapping_load8(struct mapping *mapping, size_t offset, uint32_t *value) {
  int64_t at;
  GUARDED(mapping->base, mapping->bytes, at,
          *value = __atomic_load_n(mapping->base + offset, __ATOMIC_ACQUIRE));
  return at;
}

int64_t mapping_load32(struct mapping *mapping, size_t offset, uint32_t *value) {
  int64_t at;
  GUARDED(mapping->base, mapping->bytes, at,
          *value = __atomic_load_n((uint32_t *)(void *)(mapping->base + offset), __ATOMIC_ACQUIRE));
  return at;
}

int64_t mapping_store8(struct mapping *mapping, size_t offset, uint8_t value) {
  int64_t at;
  GUARDED(mapping->base, mapping->bytes, at,
          __atomic_store_n(mapping->base + offset, value, __ATOMIC_RELEASE));
  return at;
}

int64_t mapping_store32(struct mapping *mapping, size_t offset, uint32_t value) {
  int64_t at;
  GUARDED(mapping->base, mapping->bytes, at,
          __atomic_store_n((uint32_t *)(void *)(mapping->base + offset), value, __ATOMIC_RELEASE));
  return at;
}

int64_t mapping_copy_out(struct mapping *mapping, size_t offset, void *to, size_t bytes) {
  int64_t at;
  GUARDED(mapping->base, mapping->bytes, at, memcpy(to, mapping->base + offset, bytes));
  return at;
}

int64_t mapping_copy_in(struct mapping *mapping, size_t offset, const void *from, size_t bytes) {
  int64_t at;
  GUARDED(mapping->base, mapping->bytes, at, memcpy(mapping->base + offset, from, bytes));
  return at;
}

void mapping_wake(struct mapping *mapping, size_t offset) {
  syscall(SYS_futex, mapping->base + offset, FUTEX_WAKE, INT_MAX, NULL, NULL, 0);
}
