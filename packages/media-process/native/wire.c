#include "wire.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <string.h>
#include <sys/eventfd.h>
#include <sys/uio.h>
#include <unistd.h>

static int output = -1;
/* Readable once everything is to end; never read. */
static int closing = -1;
static GMutex write_lock;

void wire_init(void) {
  output = fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 3);
  dup2(STDERR_FILENO, STDOUT_FILENO);
  fcntl(output, F_SETFL, fcntl(output, F_GETFL) | O_NONBLOCK);
  closing = eventfd(0, EFD_CLOEXEC);
}

void wire_close(void) {
  const uint64_t one = 1;
  ssize_t written = write(closing, &one, sizeof one);
  (void)written;
}

/* Waits until `fd` is ready. Returns false after wire_close(). */
static bool wait_for(int fd, short events) {
  struct pollfd polled[2] = {{.fd = fd, .events = events}, {.fd = closing, .events = POLLIN}};
  while (poll(polled, 2, -1) < 0)
    if (errno != EINTR) return false;
  return polled[1].revents == 0;
}

bool wire_read(void *to, size_t size) {
  uint8_t *at = to;
  while (size > 0) {
    if (!wait_for(STDIN_FILENO, POLLIN)) return false;
    ssize_t got = read(STDIN_FILENO, at, size);
    if (got == 0) return false;
    if (got < 0) {
      if (errno == EINTR || errno == EAGAIN) continue;
      return false;
    }
    at += got;
    size -= (size_t)got;
  }
  return true;
}

void wire_write(uint8_t type, const void *head, size_t head_size, const void *body, size_t body_size) {
  uint8_t header[HEADER_BYTES];
  store_u32(header, (uint32_t)(head_size + body_size));
  header[4] = type;
  struct iovec parts[3] = {{header, sizeof header}, {(void *)head, head_size}, {(void *)body, body_size}};
  int first = 0;
  g_mutex_lock(&write_lock);
  while (first < 3) {
    if (parts[first].iov_len == 0) {
      first++;
      continue;
    }
    ssize_t written = writev(output, parts + first, 3 - first);
    if (written < 0) {
      if (errno == EINTR) continue;
      if (errno == EAGAIN && wait_for(output, POLLOUT)) continue;
      break;
    }
    for (size_t left = (size_t)written; left > 0 && first < 3;) {
      size_t step = MIN(left, parts[first].iov_len);
      parts[first].iov_base = (uint8_t *)parts[first].iov_base + step;
      parts[first].iov_len -= step;
      left -= step;
      if (parts[first].iov_len == 0) first++;
    }
  }
  g_mutex_unlock(&write_lock);
}

void wire_write_json(uint8_t type, const GString *json) { wire_write(type, NULL, 0, json->str, json->len); }

uint16_t load_u16(const uint8_t *from) { return (uint16_t)(from[0] | from[1] << 8); }

uint32_t load_u32(const uint8_t *from) {
  return (uint32_t)load_u16(from) | (uint32_t)load_u16(from + 2) << 16;
}

uint64_t load_u64(const uint8_t *from) {
  return (uint64_t)load_u32(from) | (uint64_t)load_u32(from + 4) << 32;
}

void store_u16(uint8_t *to, uint16_t value) {
  to[0] = (uint8_t)value;
  to[1] = (uint8_t)(value >> 8);
}

void store_u32(uint8_t *to, uint32_t value) {
  store_u16(to, (uint16_t)value);
  store_u16(to + 2, (uint16_t)(value >> 16));
}

void store_u64(uint8_t *to, uint64_t value) {
  store_u32(to, (uint32_t)value);
  store_u32(to + 4, (uint32_t)(value >> 32));
}
