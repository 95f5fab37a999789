/*
 * Stands in for a kernel whose socket is full, or whose path takes no segmented messages: no loopback socket ever is.
 * Loaded with LD_PRELOAD, it appends a line to $SENDMMSG_LOG for each call: the segment's size of each message, 0 for
 * none. Each call obeys the next word of $SENDMMSG_SCRIPT: the name of an errno, a number of messages of which the
 * kernel gets no more, or `all`; after the last one all goes to the kernel. sendto and sendmsg, by which Node sends, are
 * left alone.
 */
#include <errno.h>
#include <netinet/in.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <unistd.h>

static const struct {
  const char *name;
  int error;
} errors[] = {{"EAGAIN", EAGAIN}, {"ENOBUFS", ENOBUFS}, {"EINTR", EINTR}, {"EIO", EIO}, {"EPERM", EPERM}};

static const char *script = NULL;

/* Writes the next word of the script, or `all`. */
static void next_word(char *to, size_t room) {
  if (script == NULL) script = getenv("SENDMMSG_SCRIPT");
  if (script == NULL) script = "";
  const size_t length = strcspn(script, " ");
  snprintf(to, room, "%.*s", length == 0 ? 3 : (int)length, length == 0 ? "all" : script);
  script += length + (script[length] == ' ');
}

static unsigned segment_of(struct msghdr *message) {
  const struct cmsghdr *header = CMSG_FIRSTHDR(message);
  unsigned short size = 0;
  if (header != NULL && header->cmsg_level == IPPROTO_UDP && header->cmsg_type == 103)
    memcpy(&size, CMSG_DATA(header), sizeof size);
  return size;
}

static void note(struct mmsghdr *messages, unsigned count) {
  const char *path = getenv("SENDMMSG_LOG");
  FILE *file = path == NULL ? NULL : fopen(path, "a");
  if (file == NULL) return;
  for (unsigned i = 0; i < count; i++) fprintf(file, i == 0 ? "%u" : " %u", segment_of(&messages[i].msg_hdr));
  fputc('\n', file);
  fclose(file);
}

int sendmmsg(int fd, struct mmsghdr *messages, unsigned count, int flags) {
  char word[16];
  next_word(word, sizeof word);
  note(messages, count);
  for (size_t i = 0; i < sizeof errors / sizeof errors[0]; i++) {
    if (strcmp(word, errors[i].name) != 0) continue;
    errno = errors[i].error;
    return -1;
  }
  if (strcmp(word, "all") != 0 && (unsigned)atoi(word) < count) count = (unsigned)atoi(word);
  return (int)syscall(SYS_sendmmsg, fd, messages, count, flags);
}
