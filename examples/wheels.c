/*
 * Wheels without motors: reads the robot's velocities from shared memory and says what the wheels would do.
 *
 *   cc -O2 -o wheels examples/wheels.c && ./wheels [FOLDER [SILENCE_MS [UID]]]
 *
 * Start the robot with `--sink shm`. Put your motors' controller in the place of drive(). Ctrl-C ends it.
 */
#include "../packages/shared-memory/include/farpoint_velocity.h"

#include <stdlib.h>

static const struct timespec PERIOD = {0, 20 * 1000 * 1000};

static const char *name_of(enum fp_velocity_state state) {
  switch (state) {
    case FP_VELOCITY_FRESH: return "fresh";
    case FP_VELOCITY_UNHEARD: return "unheard";
    case FP_VELOCITY_SILENT: return "silent";
    case FP_VELOCITY_ABSENT: return "absent";
    case FP_VELOCITY_INVALID: return "invalid";
  }
  return "unknown";
}

/* Says each new velocity, in a line of its own. */
static void drive(double forward, double turn, enum fp_velocity_state state) {
  static char said[128];
  char line[sizeof said];
  snprintf(line, sizeof line, "%s %.3f m/s %.3f rad/s", name_of(state), forward, turn);
  if (strcmp(line, said) == 0) return;
  memcpy(said, line, sizeof said);
  puts(line);
  fflush(stdout);
}

int main(int count, char **arguments) {
  struct fp_velocity_reader reader;
  struct fp_velocity_config config;
  memset(&config, 0, sizeof config);
  if (count > 1) config.folder = arguments[1];
  if (count > 2) config.silence_ms = (unsigned)strtoul(arguments[2], NULL, 10);
  if (count > 3) config.owner = (uid_t)strtoul(arguments[3], NULL, 10);
  config.answers = 1;
  const int error = fp_velocity_open(&reader, &config);
  if (error != 0) {
    fprintf(stderr, "%s\n", strerror(error));
    return 1;
  }
  for (;;) {
    struct fp_velocity velocity;
    const enum fp_velocity_state state = fp_velocity_read(&reader, &velocity);
    drive(velocity.linear[0], velocity.angular[2], state);
    fp_velocity_answer(&reader);
    nanosleep(&PERIOD, NULL);
  }
}
