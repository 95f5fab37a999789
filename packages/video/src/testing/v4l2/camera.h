/* The camera behind the calls: see camera.c. Those that fail return -1 and set errno, as the system's do. */
#pragma once
#include <stdbool.h>
#include <sys/types.h>

bool camera_unplugged(void);
/* Whether a file descriptor is of the camera. */
bool camera_owns(int fd);
int camera_open(int flags);
void camera_duplicated(int fd);
void camera_close(int fd);
int camera_ioctl(int fd, unsigned long request, void *argument);
void *camera_map(size_t length, off_t offset);
bool camera_mapped(const void *at);
