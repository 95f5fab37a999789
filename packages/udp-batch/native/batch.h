/* Datagrams to one destination, by as few system calls as possible. Nothing here blocks. */
#ifndef BATCH_H
#define BATCH_H

#include <stdbool.h>
#include <stdint.h>
#include <sys/socket.h>

/* Also the most segments of one message that every kernel takes (UDP_MAX_SEGMENTS in linux/udp.h). */
enum { MOST_DATAGRAMS = 64 };

struct destination {
  struct sockaddr_storage address;
  socklen_t size;
};

/* Why sending ended. The numbers are part of the interface to JavaScript. */
enum stop {
  STOP_DONE = 0,
  STOP_FULL = 1,      /* the socket takes no more for now */
  STOP_SEGMENTS = 2,  /* the path takes no segmented messages: try again without */
  STOP_REFUSED = 3    /* the system refuses the next datagram */
};

struct sending {
  uint32_t sent; /* datagrams */
  enum stop stop;
};

/* `text`: a numeric IPv4 or IPv6 address; the latter may end with % and the name or number of an interface. */
bool parse_destination(const char *text, uint32_t port, struct destination *to);

/* The local port of a bound UDP socket; 0 for any other descriptor. */
uint32_t udp_port(int fd);

/* Whether the kernel knows segmented messages. An older one would ignore the request, and send one huge datagram. */
bool knows_segments(int fd);

/*
 * `bytes` are the datagrams, one after the other; `count` is at most MOST_DATAGRAMS. With `segments`, datagrams of equal
 * length leave as one message that the kernel or the network card cuts up (UDP_SEGMENT, Linux 4.18).
 */
struct sending send_datagrams(int fd, const struct destination *to, uint8_t *bytes, const uint32_t *lengths,
                              uint32_t count, bool segments);

#endif
