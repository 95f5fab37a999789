#include "batch.h"

#include <arpa/inet.h>
#include <errno.h>
#include <net/if.h>
#include <netinet/in.h>
#include <stdlib.h>
#include <string.h>
#include <sys/uio.h>

/* linux/udp.h; older headers lack it. */
enum { UDP_SEGMENT_OPTION = 103 };
/* The payload of one IPv4 message: 65535 without the headers of IP and UDP. */
enum { MOST_MESSAGE_BYTES = 65535 - 20 - 8 };

/* The room for one control message with a segment's size, aligned for its header. */
union segment_control {
  char bytes[CMSG_SPACE(sizeof(uint16_t))];
  struct cmsghdr header;
};

static bool parse_scope(const char *text, uint32_t *scope) {
  char *end = NULL;
  *scope = if_nametoindex(text);
  if (*scope != 0) return true;
  const unsigned long number = strtoul(text, &end, 10);
  if (end == text || *end != '\0' || number > UINT32_MAX) return false;
  *scope = (uint32_t)number;
  return true;
}

static bool parse_ipv6(const char *text, struct in6_addr *address, uint32_t *scope) {
  char plain[INET6_ADDRSTRLEN];
  const char *percent = strchr(text, '%');
  const size_t length = percent == NULL ? strlen(text) : (size_t)(percent - text);
  if (length >= sizeof plain) return false;
  memcpy(plain, text, length);
  plain[length] = '\0';
  return inet_pton(AF_INET6, plain, address) == 1 && (percent == NULL || parse_scope(percent + 1, scope));
}

bool parse_destination(const char *text, uint32_t port, struct destination *to) {
  if (port == 0 || port > UINT16_MAX) return false;
  memset(to, 0, sizeof *to);
  struct sockaddr_in *v4 = (struct sockaddr_in *)&to->address;
  struct sockaddr_in6 *v6 = (struct sockaddr_in6 *)&to->address;
  if (inet_pton(AF_INET, text, &v4->sin_addr) == 1) {
    v4->sin_family = AF_INET;
    v4->sin_port = htons((uint16_t)port);
    to->size = sizeof *v4;
    return true;
  }
  if (!parse_ipv6(text, &v6->sin6_addr, &v6->sin6_scope_id)) return false;
  v6->sin6_family = AF_INET6;
  v6->sin6_port = htons((uint16_t)port);
  to->size = sizeof *v6;
  return true;
}

uint32_t udp_port(int fd) {
  int protocol = 0;
  socklen_t size = sizeof protocol;
  if (getsockopt(fd, SOL_SOCKET, SO_PROTOCOL, &protocol, &size) != 0 || protocol != IPPROTO_UDP) return 0;
  struct sockaddr_storage address;
  size = sizeof address;
  if (getsockname(fd, (struct sockaddr *)&address, &size) != 0) return 0;
  if (address.ss_family == AF_INET) return ntohs(((struct sockaddr_in *)&address)->sin_port);
  if (address.ss_family == AF_INET6) return ntohs(((struct sockaddr_in6 *)&address)->sin6_port);
  return 0;
}

bool knows_segments(int fd) {
  int bytes = 0;
  socklen_t size = sizeof bytes;
  return getsockopt(fd, IPPROTO_UDP, UDP_SEGMENT_OPTION, &bytes, &size) == 0;
}

/* How many of the datagrams fit one segmented message: all have the first one's length, only the last may be shorter. */
static uint32_t run_length(const uint32_t *lengths, uint32_t count) {
  const uint32_t length = lengths[0];
  if (length == 0 || length > MOST_MESSAGE_BYTES) return 1;
  const uint32_t fit = MOST_MESSAGE_BYTES / length;
  const uint32_t most = fit < count ? fit : count;
  uint32_t run = 1;
  while (run < most && lengths[run] == length) run++;
  if (run < most && lengths[run] > 0 && lengths[run] < length) run++;
  return run;
}

static void ask_for_segments(struct msghdr *message, union segment_control *control, uint32_t length) {
  const uint16_t segment = (uint16_t)length;
  memset(control, 0, sizeof *control);
  message->msg_control = control;
  message->msg_controllen = sizeof control->bytes;
  struct cmsghdr *header = CMSG_FIRSTHDR(message);
  header->cmsg_level = IPPROTO_UDP;
  header->cmsg_type = UDP_SEGMENT_OPTION;
  header->cmsg_len = CMSG_LEN(sizeof segment);
  memcpy(CMSG_DATA(header), &segment, sizeof segment);
}

static enum stop stop_of(int error, bool segmented) {
  switch (error) {
    case EAGAIN:
    case ENOBUFS: return STOP_FULL;
    /* No checksums in hardware, segments longer than the path's MTU, or a path that cannot cut at all. */
    case EIO:
    case EINVAL:
    case EMSGSIZE:
    case EOPNOTSUPP: return segmented ? STOP_SEGMENTS : STOP_REFUSED;
    default: return STOP_REFUSED;
  }
}

struct sending send_datagrams(int fd, const struct destination *to, uint8_t *bytes, const uint32_t *lengths,
                              uint32_t count, bool segments) {
  struct mmsghdr messages[MOST_DATAGRAMS];
  struct iovec pieces[MOST_DATAGRAMS];
  union segment_control controls[MOST_DATAGRAMS];
  uint32_t runs[MOST_DATAGRAMS];
  uint32_t made = 0;
  memset(messages, 0, sizeof messages);
  for (uint32_t at = 0; at < count; made++) {
    const uint32_t run = segments ? run_length(lengths + at, count - at) : 1;
    size_t length = 0;
    for (uint32_t i = 0; i < run; i++) length += lengths[at + i];
    struct msghdr *message = &messages[made].msg_hdr;
    pieces[made] = (struct iovec){.iov_base = bytes, .iov_len = length};
    message->msg_name = (void *)&to->address;
    message->msg_namelen = to->size;
    message->msg_iov = &pieces[made];
    message->msg_iovlen = 1;
    if (run > 1) ask_for_segments(message, &controls[made], lengths[at]);
    runs[made] = run;
    bytes += length;
    at += run;
  }
  struct sending result = {.sent = 0, .stop = STOP_DONE};
  for (uint32_t from = 0; from < made;) {
    const int taken = sendmmsg(fd, messages + from, made - from, MSG_DONTWAIT | MSG_NOSIGNAL);
    if (taken < 0 && errno == EINTR) continue;
    if (taken < 0) {
      result.stop = stop_of(errno, runs[from] > 1);
      break;
    }
    for (int i = 0; i < taken; i++) result.sent += runs[from++];
  }
  return result;
}
