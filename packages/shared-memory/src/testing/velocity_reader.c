/*
 * Reads velocities when it is told to, at the times that it is told: `velocity_reader FOLDER SILENCE_MS`. C and C++.
 * See src/velocity-readers.stack.test.ts.
 */
#include "../../include/farpoint_velocity.h"

#include <stdlib.h>

static const char *const NAMES[] = {"fresh", "unheard", "silent", "absent", "invalid"};

int main(int count, char **arguments) {
  struct fp_velocity_reader reader;
  struct fp_velocity_config config;
  struct fp_velocity v;
  char line[64];
  if (count != 3) return 2;
  memset(&config, 0, sizeof config);
  config.folder = arguments[1];
  config.silence_ms = (unsigned)strtoul(arguments[2], NULL, 10);
  config.answers = 1;
  if (fp_velocity_open(&reader, &config) != 0) {
    puts("refused");
    return 0;
  }
  puts("ready");
  fflush(stdout);
  while (fgets(line, sizeof line, stdin) != NULL) {
    if (strncmp(line, "answer", 6) == 0) {
      puts(fp_velocity_answer(&reader) == 0 ? "told" : "not told");
    } else {
      const enum fp_velocity_state state = fp_velocity_read_at(&reader, strtoull(line, NULL, 10) * 1000000u, &v);
      printf("%s %.17g %.17g %.17g %.17g %.17g %.17g\n", NAMES[state], v.linear[0], v.linear[1], v.linear[2],
             v.angular[0], v.angular[1], v.angular[2]);
    }
    fflush(stdout);
  }
  fp_velocity_close(&reader);
  return 0;
}
