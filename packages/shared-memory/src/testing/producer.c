/* Writes what src/producers.stack.test.ts expects: `producer FOLDER points|depth16|depth32|reference|refusals`. C and C++. */
#include "../../include/farpoint_shm.h"

#include <stdio.h>
#include <stdlib.h>

static void check(int error, int wanted, const char *what) {
  if (error == wanted) return;
  fprintf(stderr, "%s: %s\n", what, strerror(error));
  exit(1);
}

static struct fp_frame frame_of(enum fp_format format) {
  struct fp_frame frame;
  memset(&frame, 0, sizeof frame);
  frame.capture_ns = 123456789;
  frame.width = 4;
  frame.height = 3;
  frame.has_pose = 1;
  frame.position[0] = 1.5;
  frame.orientation[3] = 1;
  frame.latency_test = 1;
  if (format != FP_POINTS) {
    frame.has_lens = 1;
    frame.lens[0] = frame.lens[1] = 2;
    frame.lens[2] = frame.lens[3] = 1;
    frame.depth_unit = 0.001f;
  }
  return frame;
}

static void write_frame(struct fp_cloud *cloud, int number) {
  const struct fp_frame frame = frame_of(cloud->format);
  uint8_t *payload = (uint8_t *)fp_cloud_begin(cloud);
  uint8_t *colours = payload + fp_colour_offset(cloud->format, frame.width, frame.height);
  for (int i = 0; i < 12; i++) {
    const float metres = (float)(i + number);
    const uint16_t units = (uint16_t)((i + number) * 1000);
    const uint8_t rgba[4] = {(uint8_t)i, (uint8_t)(i + 1), (uint8_t)(i + 2), 255};
    if (cloud->format == FP_POINTS) {
      memcpy(payload + i * 16, &metres, 4);
      memcpy(payload + i * 16 + 4, &metres, 4);
      memcpy(payload + i * 16 + 8, &metres, 4);
      memcpy(payload + i * 16 + 12, rgba, 4);
      continue;
    }
    if (cloud->format == FP_DEPTH16) memcpy(payload + i * 2, &units, 2);
    else memcpy(payload + i * 4, &metres, 4);
    memcpy(colours + i * 4, rgba, 4);
  }
  check(fp_cloud_publish(cloud, &frame), 0, "publish");
}

static struct fp_cloud open_cloud(const char *folder, enum fp_format format, int wanted) {
  struct fp_cloud cloud;
  struct fp_cloud_config config;
  memset(&config, 0, sizeof config);
  config.format = format;
  config.max_points = 12;
  config.frames_per_second = 30;
  config.folder = folder;
  config.mode = 0660;
  check(fp_cloud_open(&cloud, &config), wanted, "open");
  return cloud;
}

static void clouds(const char *folder, enum fp_format format) {
  struct fp_cloud cloud = open_cloud(folder, format, 0);
  for (int number = 1; number <= 6; number++) write_frame(&cloud, number);
  /* Begun and not published: must not be visible. */
  memset(fp_cloud_begin(&cloud), 0xff, 12);
  fp_cloud_close(&cloud);
}

static void refusals(const char *folder) {
  struct fp_cloud cloud = open_cloud(folder, FP_DEPTH16, 0);
  struct fp_frame frame = frame_of(FP_DEPTH16);
  char path[FP_PATH_BYTES];
  open_cloud(folder, FP_POINTS, EBUSY);
  fp_cloud_begin(&cloud);
  frame.width = 5;
  check(fp_cloud_publish(&cloud, &frame), EINVAL, "too many points");
  frame = frame_of(FP_DEPTH16);
  frame.has_lens = 0;
  check(fp_cloud_publish(&cloud, &frame), EINVAL, "no lens");
  frame = frame_of(FP_DEPTH16);
  frame.orientation[3] = 0.5;
  check(fp_cloud_publish(&cloud, &frame), EINVAL, "no unit quaternion");
  frame = frame_of(FP_DEPTH16);
  snprintf(path, sizeof path, "%s/farpoint_cloud", folder);
  unlink(path);
  check(fp_cloud_publish(&cloud, &frame), ESTALE, "removed");
  fp_cloud_close(&cloud);
}

static void reference(const char *folder) {
  struct fp_reference producer;
  uint32_t bits_per_second = 0;
  int latency_test = 0;
  check(fp_reference_open(&producer, folder, 0), 0, "open");
  check(fp_reference_wait(&producer, 5000, &bits_per_second, &latency_test), 0, "wait");
  memset(fp_reference_payload(&producer), 1, 1208);
  check(fp_reference_publish(&producer, 1207), EINVAL, "no whole points");
  check(fp_reference_publish(&producer, 1208), 0, "publish");
  check(fp_reference_wait(&producer, 1, &bits_per_second, &latency_test), ETIMEDOUT, "nobody takes it");
  fp_reference_close(&producer);
  printf("%u %d\n", (unsigned)bits_per_second, latency_test);
}

int main(int count, char **arguments) {
  if (count != 3) return 2;
  if (strcmp(arguments[2], "points") == 0) clouds(arguments[1], FP_POINTS);
  else if (strcmp(arguments[2], "depth16") == 0) clouds(arguments[1], FP_DEPTH16);
  else if (strcmp(arguments[2], "depth32") == 0) clouds(arguments[1], FP_DEPTH32);
  else if (strcmp(arguments[2], "refusals") == 0) refusals(arguments[1]);
  else reference(arguments[1]);
  return 0;
}
